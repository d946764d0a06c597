// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/ball_contacts.hpp"

#include "contact/tracking/slip_state.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace plekton::contact {
namespace {

/// The slot that nothing comes from.
constexpr std::uint32_t kNoSlot = std::numeric_limits<std::uint32_t>::max();

}  // namespace

BallContacts::Kind::Kind(const AnyLaw::Functions& of, bool keeps) noexcept
    : law(&of), keeps_parameters(keeps) {
  std::size_t rows = PairNumbersOfRow::kHistory + of.history_numbers;
  force = of.force_of_state ? 0 : rows;
  if (force > 0) rows += 3;
  parameters = keeps ? rows : 0;
  if (keeps) rows += of.parameter_numbers;
  row_size = rows * kLanes;
}

/// Numbers are 0 at first: nothing touches.
void BallContacts::Table::assign(const BallBlocks& blocks) {
  make_room(places, blocks.row_count());
  places.clear();
  std::size_t line = 0;
  for (const BallBlocks::Stretch& stretch : blocks.stretches()) {
    for (std::uint32_t row = 0; row < stretch.row_count; ++row) {
      places.push_back({static_cast<std::uint32_t>(line), stretch.kind});
      line += kinds[stretch.kind].row_size / kLanes;
    }
  }
  make_room(numbers, line * kLanes);
  numbers.assign(line * kLanes, 0.0);
  make_room(touched, places.size());
  touched.assign(places.size(), {});
}

ContactMemory<AnyLaw> BallContacts::Table::memory(std::size_t slot) const noexcept {
  const ConstRows of_row = rows(slot);
  ContactMemory<AnyLaw> memory;
  memory.normal = of_row.from(PairNumbersOfRow::kNormal).at<Vec3>(slot % kLanes);
  memory.history.law = kind(slot).law;
  of_row.from(PairNumbersOfRow::kHistory)
      .get_numbers(slot % kLanes, memory.history.numbers.data(), kind(slot).law->history_numbers);
  return memory;
}

double BallContacts::rebuild(std::span<const geometry::IndexPair> keys, std::span<const Ball> balls,
                             const MaterialPairs& materials, geometry::ThreadPool& pool,
                             Positions x) {
  balls_ = balls;
  make_room(old_slots_, keys.size());
  old_slots_.assign(keys.size(), kNoSlot);
  double lost = 0.0;
  match_keys(
      keys_, keys,
      [&](std::size_t i, bool is_known, std::size_t old) {
        if (is_known && table_.has_touched(blocks_.slot(old))) old_slots_[i] = blocks_.slot(old);
      },
      [&](std::size_t old) {
        if (!table_.has_touched(blocks_.slot(old))) return;
        ContactMemory<AnyLaw> memory = table_.memory(blocks_.slot(old));
        lost += forget<AnyLaw>(materials.combine(ball(keys_[old].a), ball(keys_[old].b)), memory);
      });
  make_room(keys_, keys.size());
  keys_.assign(keys.begin(), keys.end());
  std::swap(table_, last_table_);
  find_kinds(balls, materials);
  blocks_.assign(keys, balls, kinds_, pool, x);
  table_.assign(blocks_);
  set_parameters(materials);
  move_memories(last_table_);
  return lost;
}

/// If all balls are of one material, with nothing said of it as a pair, and the law asks for no
/// more than radii, computing parameters anew takes less time than reading them would.
void BallContacts::find_kinds(std::span<const Ball> balls, const MaterialPairs& materials) {
  table_.kinds.clear();
  kinds_.clear();
  common_.reset();
  if (keys_.empty()) return;
  std::int32_t last = 0;
  for (const geometry::IndexPair& key : keys_) last = std::max(last, key.b);
  const MaterialId first = balls.front().material;
  if (std::ranges::all_of(balls.first(static_cast<std::size_t>(last) + 1),
                          [&](const Ball& ball) { return ball.material == first; })) {
    const AnyLaw::Properties& properties = materials.properties(first, first);
    const bool keeps = !properties.law->combines_radii(properties);
    if (!keeps) common_ = {materials.at(first), properties};
    table_.kinds.emplace_back(*properties.law, keeps);
    return;
  }
  make_room(kinds_, keys_.size());
  for (const geometry::IndexPair& key : keys_) {
    const AnyLaw::Functions* const law =
        materials.properties(ball(key.a).material, ball(key.b).material).law;
    auto known = std::ranges::find(table_.kinds, law, &Kind::law);
    if (known == table_.kinds.end()) {
      table_.kinds.emplace_back(*law, true);
      known = table_.kinds.end() - 1;
    }
    kinds_.push_back(static_cast<std::uint8_t>(known - table_.kinds.begin()));
  }
}

void BallContacts::set_parameters(const MaterialPairs& materials) {
  if (common_) return;
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    const std::uint32_t slot = blocks_.slot(i);
    const Kind& kind = table_.kind(slot);
    table_.rows(slot)
        .from(kind.parameters)
        .set_numbers(slot % kLanes,
                     materials.combine(ball(keys_[i].a), ball(keys_[i].b)).numbers.data(),
                     kind.law->parameter_numbers);
  }
}

/// From the slots that pairs had in the list before, to those that they have now.
void BallContacts::move_memories(const Table& old) {
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    if (old_slots_[i] == kNoSlot) continue;
    const std::uint32_t from = old_slots_[i], to = blocks_.slot(i);
    const ContactMemory<AnyLaw> memory = old.memory(from);
    const Rows rows = table_.rows(to);
    rows.from(PairNumbersOfRow::kNormal).set(to % kLanes, memory.normal);
    rows.from(PairNumbersOfRow::kHistory)
        .set_numbers(to % kLanes, memory.history.numbers.data(),
                     memory.history.law->history_numbers);
    table_.touched[to / kLanes].set_moved(
        to % kLanes, true, old.touched[from / kLanes].since_numbered(from % kLanes));
  }
}

/// Of pair i of the list.
BallContacts::Parameters BallContacts::parameters(std::size_t i) const noexcept {
  if (common_)
    return AnyLaw::combine(common_->properties, {common_->material, ball(keys_[i].a).radius},
                           {common_->material, ball(keys_[i].b).radius});
  const std::uint32_t slot = blocks_.slot(i);
  const Kind& kind = table_.kind(slot);
  Parameters kept;
  kept.law = kind.law;
  table_.rows(slot)
      .from(kind.parameters)
      .get_numbers(slot % kLanes, kept.numbers.data(), kind.law->parameter_numbers);
  return kept;
}

/// N, of the last step.
Vec3 BallContacts::force_on_b(const Touching& pair) const noexcept {
  const Kind& kind = table_.kind(pair.slot);
  if (kind.law->force_of_state)
    return kind.law->force_of_state(pair.parameters, pair.gap, pair.memory.normal,
                                    pair.memory.history);
  return table_.rows(pair.slot).from(kind.force).at<Vec3>(pair.slot % kLanes);
}

double BallContacts::advance(const Motion& motion, double dt, geometry::ThreadPool& pool,
                             NodeForces& forces) {
  const std::span<const BallBlocks::Block> blocks = blocks_.blocks();
  make_room(lent_, blocks_.borrowed_count());
  lent_.resize(blocks_.borrowed_count());
  outcomes_.resize(blocks.size());
  work_.resize(static_cast<std::size_t>(pool.thread_count()));
  for (BallWork& work : work_) {
    work.balls.reserve(blocks_.largest_member_count());
    make_room(work.sums, blocks_.largest_member_count());
    work.sums.resize(blocks_.largest_member_count());
    work.dt = dt;
  }
  pool.for_each_shared(blocks.size(), [&](std::size_t k, int worker) {
    BallWork& work = work_[static_cast<std::size_t>(worker)];
    work.outcome = {};
    advance_block(blocks[k], motion, work);
    outcomes_[k] = work.outcome;
    hand_over(blocks[k], work, forces);
  });
  set_others_zero(forces, pool);
  return_loans(forces, pool);
  double dissipated = 0.0;
  for (const Outcome& outcome : outcomes_) dissipated += outcome.total_dissipated();
  return dissipated;
}

void BallContacts::advance_block(const BallBlocks::Block& block, const Motion& motion,
                                 BallWork& work) {
  work.balls.load(blocks_.members(block), motion);
  std::fill_n(work.sums.data(), block.member_count, BallSum{Vec3::Zero(), Vec3::Zero(), {}});
  for (const BallBlocks::Stretch& stretch : blocks_.stretches(block))
    table_.kinds[stretch.kind].law->advance_balls(stretch_of(stretch), work);
}

BallStretch BallContacts::stretch_of(const BallBlocks::Stretch& stretch) noexcept {
  const Kind& kind = table_.kinds[stretch.kind];
  const std::size_t first = stretch.first_row;
  return {blocks_.row(first),
          table_.numbers.data() + kLanes * std::size_t{table_.places[first].first_line},
          &table_.touched[first],
          stretch.row_count,
          kind.row_size,
          kind.force,
          kind.parameters,
          common_ ? &common_->material : nullptr,
          stretch.was_apart};
}

std::size_t BallContacts::touching() const noexcept {
  std::size_t count = 0;
  for (const Outcome& outcome : outcomes_) count += outcome.touching;
  return count;
}

double BallContacts::largest_overlap_ratio() const noexcept {
  double deepest = 0.0;
  for (const Outcome& outcome : outcomes_) deepest = std::max(deepest, outcome.largest_ratio());
  return deepest;
}

double BallContacts::elastic_energy() const {
  double energy = 0.0;
  for_each_lane([&](const Touching& pair) {
    energy += AnyLaw::elastic_normal_energy(pair.parameters, pair.gap) +
              AnyLaw::history_energy(pair.parameters, pair.memory.history);
  });
  return energy;
}

void BallContacts::number(std::int64_t& last) {
  PairNumbers::Reader known(numbers_);
  PairNumbers numbers;
  for_each_lane([&](const Touching& pair) {
    const bool has_one = table_.touched[pair.slot / kLanes].since_numbered(pair.slot % kLanes);
    numbers.add(pair.key, has_one ? known.of(pair.key) : ++last);
  });
  numbers_ = std::move(numbers);
  for (TouchedLanes& touched : table_.touched) touched.set_numbered();
}

void BallContacts::for_each_row(Positions x, VisitRow visit) const {
  PairNumbers::Reader numbers(numbers_);
  for_each_lane([&](const Touching& pair) {
    const Ball &a = ball(pair.key.a), &b = ball(pair.key.b);
    ContactRow row;
    if (table_.touched[pair.slot / kLanes].since_numbered(pair.slot % kLanes))
      row.id = numbers.of(pair.key);
    row.a = {BodyKind::sphere, pair.key.a, geometry::Feature(a.node)};
    row.b = {BodyKind::sphere, pair.key.b, geometry::Feature(b.node)};
    row.point_a = x[index_of(a.node)];
    row.point_b = x[index_of(b.node)];
    row.normal = pair.memory.normal;
    row.gap = pair.gap;
    row.point = row.point_a + (a.radius + 0.5 * row.gap) * row.normal;
    set_force(row, force_on_b(pair));
    row.moment = AnyLaw::moment(pair.memory.history, pair.memory.normal);
    set_state<AnyLaw>(row, pair.parameters, pair.memory.history,
                      AnyLaw::elastic_normal_force(pair.parameters, row.gap));
    visit(row);
  });
}

void BallContacts::hand_over(const BallBlocks::Block& block, const BallWork& work,
                                  NodeForces& forces) {
  constexpr std::size_t kAhead = 16;
  const auto owned = blocks_.owned(block);
  const BallSum* const sums = work.sums.data();
  for (std::size_t m = 0; m < owned.size(); ++m) {
    const std::size_t ahead = index_of(owned[std::min(m + kAhead, owned.size() - 1)].node);
    __builtin_prefetch(&forces.force[ahead], 1);
    __builtin_prefetch(&forces.torque[ahead], 1);
    forces.force[index_of(owned[m].node)] = sums[m].force;
    forces.torque[index_of(owned[m].node)] = sums[m].torque;
  }
  std::copy_n(sums + owned.size(), block.borrowed(), lent_.begin() + block.first_borrowed);
}

void BallContacts::set_others_zero(NodeForces& forces, geometry::ThreadPool& pool) const {
  if (blocks_.other_nodes().empty()) return;
  pool.for_each_range(forces.force.size(), [&](std::size_t begin, std::size_t end, int) {
    for (const BallBlocks::NodeRange& range : blocks_.other_nodes()) {
      const std::size_t first = std::max(begin, range.begin);
      const std::size_t last = std::min(end, range.end);
      if (first < last) forces.set_zero(first, last);
    }
  });
}

void BallContacts::return_loans(NodeForces& forces, geometry::ThreadPool& pool) const {
  const auto add = [&](NodeId node, std::size_t borrowed) {
    forces.force[index_of(node)] += lent_[borrowed].force;
    forces.torque[index_of(node)] += lent_[borrowed].torque;
  };
  const auto ask = [&](NodeId node, std::size_t borrowed) {
    __builtin_prefetch(&lent_[borrowed]);
    __builtin_prefetch(&forces.force[index_of(node)]);
    __builtin_prefetch(&forces.torque[index_of(node)]);
  };
  pool.for_each_range(blocks_.blocks().size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t k = begin; k < end; ++k) blocks_.for_each_loan(k, add, ask);
  });
}

}  // namespace plekton::contact
