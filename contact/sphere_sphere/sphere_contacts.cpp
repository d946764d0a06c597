// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/sphere_contacts.hpp"

#include "contact/sphere_sphere/move_slots.hpp"
#include "contact/tracking/contact_state.hpp"
#include "contact/tracking/slip_state.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace plekton::contact {

double SphereContacts::rebuild(std::span<const geometry::IndexPair> keys,
                               std::span<const SphereBody> spheres, const MaterialPairs& materials,
                               geometry::ThreadPool& pool, Positions x) {
  tell_touched();
  make_room(old_slots_, keys.size());
  old_slots_.assign(keys.size(), kNoSlot);
  left_.clear();
  match_keys(
      keys_, keys,
      [&](std::size_t i, bool is_known, std::size_t old) {
        if (is_known && table_.has_touched(blocks_.slot(old))) old_slots_[i] = blocks_.slot(old);
      },
      [&](std::size_t old) {
        if (table_.has_touched(blocks_.slot(old))) left_.push_back(static_cast<std::uint32_t>(old));
      });
  spheres_ = spheres;
  const double lost = energy_lost(materials);
  materials_ = &materials;
  make_room(keys_, keys.size());
  keys_.assign(keys.begin(), keys.end());
  find_kinds();
  blocks_.assign(keys, spheres, kinds_, pool, x);
  BlockHolders holders;
  if (shared_) {
    shared_->assign(blocks_);
    holders = {&shared_->ranks(), shared_->holders()};
  }
  table_.take(blocks_, kinds_of_list_, old_slots_, holders);
  set_parameters();
  return lost;
}

/// J, of pairs that touch and are on the list no more.
double SphereContacts::energy_lost(const MaterialPairs& materials) const {
  std::vector<double> lost;
  for (const std::uint32_t old : left_) {
    const std::uint32_t slot = blocks_.slot(old);
    lost.push_back(0.0);
    if (!table_.holds(slot)) continue;
    ContactMemory<AnyLaw> memory = table_.memory(slot);
    const auto parameters = materials.combine(sphere(keys_[old].a), sphere(keys_[old].b));
    lost.back() = forget<AnyLaw>(parameters, memory, {});
  }
  if (table_.is_shared_out()) {
    geometry::share(shared_->ranks(), room_, [&](const auto& visit) {
      for (std::size_t n = 0; n < lost.size(); ++n)
        visit(table_.holder(blocks_.slot(left_[n])),
              std::as_writable_bytes(std::span(&lost[n], 1)));
    });
  }
  return std::accumulate(lost.begin(), lost.end(), 0.0);
}

void SphereContacts::share_out(std::span<const NodeId> met) {
  if (shared_) shared_->share_motion(blocks_, met);
}

/// If all spheres are of one material, with nothing said of it as a pair, and the law asks for no
/// more than radii, computing parameters anew takes less time than reading them would.
void SphereContacts::find_kinds() {
  std::vector<PairKind>& kinds = kinds_of_list_;
  kinds.clear();
  kinds_.clear();
  common_.reset();
  if (keys_.empty()) return;
  std::int32_t last = 0;
  for (const geometry::IndexPair& key : keys_) last = std::max(last, key.b);
  const MaterialId first = spheres_.front().material;
  if (std::ranges::all_of(spheres_.first(static_cast<std::size_t>(last) + 1),
                          [&](const SphereBody& sphere) { return sphere.material == first; })) {
    const AnyLaw::Properties& properties = materials_->properties(first, first);
    const bool keeps = !properties.law->combines_radii(properties);
    if (!keeps) common_ = {materials_->at(first), properties};
    kinds.emplace_back(*properties.law, keeps);
    return;
  }
  make_room(kinds_, keys_.size());
  for (const geometry::IndexPair& key : keys_) {
    const AnyLaw::Functions* const law =
        materials_->properties(sphere(key.a).material, sphere(key.b).material).law;
    auto known = std::ranges::find(kinds, law, &PairKind::law);
    if (known == kinds.end()) {
      kinds.emplace_back(*law, true);
      known = kinds.end() - 1;
    }
    kinds_.push_back(static_cast<std::uint8_t>(known - kinds.begin()));
  }
}

void SphereContacts::set_parameters() {
  if (common_) return;
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    const std::uint32_t slot = blocks_.slot(i);
    if (!table_.holds(slot)) continue;
    const PairKind& kind = table_.kind(slot);
    table_.rows(slot)
        .from(kind.parameters)
        .set_numbers(slot % kLanes,
                     materials_->combine(sphere(keys_[i].a), sphere(keys_[i].b)).numbers.data(),
                     kind.law->parameter_numbers);
  }
}

/// Of pair i of the list.
SphereContacts::Parameters SphereContacts::parameters(std::size_t i) const noexcept {
  if (common_)
    return AnyLaw::combine(common_->properties, {common_->material, sphere(keys_[i].a).radius},
                           {common_->material, sphere(keys_[i].b).radius});
  const std::uint32_t slot = blocks_.slot(i);
  if (!table_.holds(slot)) return materials_->combine(sphere(keys_[i].a), sphere(keys_[i].b));
  const PairKind& kind = table_.kind(slot);
  Parameters kept;
  kept.law = kind.law;
  table_.rows(slot)
      .from(kind.parameters)
      .get_numbers(slot % kLanes, kept.numbers.data(), kind.law->parameter_numbers);
  return kept;
}

SphereContacts::PairState SphereContacts::state_of(std::uint32_t slot) const noexcept {
  PairState state{table_.gap(slot), table_.memory(slot)};
  const PairKind& kind = table_.kind(slot);
  if (kind.force > 0) state.force = table_.rows(slot).from(kind.force).at<Vec3>(slot % kLanes);
  return state;
}

/// N, of the last step, of pair i of the list.
Vec3 SphereContacts::force_on_b(std::size_t i, const PairState& pair) const noexcept {
  const AnyLaw::Functions& law = *table_.kind(blocks_.slot(i)).law;
  if (!law.force_of_state) return pair.force;
  return law.force_of_state(parameters(i), pair.gap, pair.memory.normal, pair.memory.history);
}

double SphereContacts::advance(const Motion& motion, double dt, geometry::ThreadPool& pool,
                               NodeForces& forces) {
  const std::span<const SphereBlocks::Block> blocks = blocks_.blocks();
  make_room(ghost_sums_, blocks_.ghost_count());
  ghost_sums_.resize(blocks_.ghost_count());
  outcomes_.resize(blocks.size());
  work_.resize(static_cast<std::size_t>(pool.thread_count()));
  for (SphereWork& work : work_) {
    work.spheres.reserve(blocks_.largest_member_count());
    make_room(work.sums, blocks_.largest_member_count());
    work.sums.resize(blocks_.largest_member_count());
    work.dt = dt;
  }
  if (shared_ && shared_->is_worth_it()) {
    share_blocks(motion, pool, forces);
  } else {
    pool.for_each_shared(blocks.size(), [&](std::size_t k, int worker) {
      compute_block(k, motion, work_[static_cast<std::size_t>(worker)], forces);
    });
    add_ghost_sums(forces, pool);
    totals_ = {};
    for (const Outcome& outcome : outcomes_) totals_.add(outcome);
  }
  set_others_zero(forces, pool);
  return totals_.dissipated.value();
}

void SphereContacts::compute_block(std::size_t k, const Motion& motion, SphereWork& work,
                                   NodeForces& forces) {
  const SphereBlocks::Block& block = blocks_.blocks()[k];
  work.outcome = {};
  advance_block(block, motion, work);
  outcomes_[k] = work.outcome;
  hand_over(block, work, forces);
}

/// Ghosts' sums go where their spheres are added up, while blocks without such are computed; then
/// all have all forces on common nodes.
void SphereContacts::share_blocks(const Motion& motion, geometry::ThreadPool& pool,
                                  NodeForces& forces) {
  const auto compute = [&](std::span<const std::uint32_t> blocks) {
    pool.for_each_shared(blocks.size(), [&](std::size_t i, int worker) {
      compute_block(blocks[i], motion, work_[static_cast<std::size_t>(worker)], forces);
      if (worker == 0) shared_->ranks().progress();  // on the thread that began the exchange
    });
  };
  compute(shared_->border());
  shared_->begin_ghosts(ghost_sums_);
  compute(shared_->inner());
  shared_->end_ghosts(ghost_sums_);
  const std::span<const std::uint32_t> own = shared_->own();
  pool.for_each_range(own.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) add_ghost_sums(own[i], forces);
  });
  BlockTotals of_own;
  for (const std::uint32_t k : own) of_own.add(outcomes_[k]);
  totals_ = shared_->gather(forces, of_own);
  is_told_ = false;
}

void SphereContacts::tell_touched() const {
  if (is_told_) return;
  is_told_ = true;
  table_.tell_touched();
}

void SphereContacts::advance_block(const SphereBlocks::Block& block, const Motion& motion,
                                   SphereWork& work) {
  work.spheres.load(blocks_.members(block), motion);
  std::fill_n(work.sums.data(), block.member_count, SphereSum{});
  for (const SphereBlocks::Range& range : blocks_.ranges(block))
    table_.kinds()[range.kind].law->advance_spheres(range_of(range), work);
}

SphereRange SphereContacts::range_of(const SphereBlocks::Range& range) noexcept {
  const PairKind& kind = table_.kinds()[range.kind];
  const std::size_t first = range.first_row;
  return {blocks_.row(first),
          table_.rows(first * kLanes).numbers(),
          &table_.touched(first * kLanes),
          range.row_count,
          kind.row_size,
          kind.force,
          kind.parameters,
          common_ ? &common_->material : nullptr,
          range.was_apart};
}

double SphereContacts::elastic_energy() const {
  double energy = 0.0;
  for_each_told<double>(
      [this](std::size_t i, std::uint32_t slot) {
        const Parameters of_pair = parameters(i);
        return AnyLaw::elastic_normal_energy(of_pair, table_.gap(slot)) +
               AnyLaw::history_energy(of_pair, table_.memory(slot).history);
      },
      [&](std::size_t, double of_pair) { energy += of_pair; });
  return energy;
}

void SphereContacts::assign_ids(std::int64_t& last) {
  tell_touched();
  PairNumbers::Reader known(numbers_);
  PairNumbers numbers;
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    const std::uint32_t slot = blocks_.slot(i);
    if (!table_.has_touched(slot)) continue;
    numbers.add(keys_[i], table_.is_numbered(slot) ? known.of(keys_[i]) : ++last);
  }
  numbers_ = std::move(numbers);
  table_.set_numbered();
}

void SphereContacts::for_each_record(Positions x, VisitRecord visit) const {
  PairNumbers::Reader numbers(numbers_);
  for_each_state([&](std::size_t i, const PairState& pair) {
    const geometry::IndexPair& key = keys_[i];
    const SphereBody &a = sphere(key.a), &b = sphere(key.b);
    ContactRecord row;
    if (table_.is_numbered(blocks_.slot(i))) row.id = numbers.of(key);
    row.a = {BodyKind::sphere, key.a, geometry::Feature(a.node)};
    row.b = {BodyKind::sphere, key.b, geometry::Feature(b.node)};
    row.point_a = x[index_of(a.node)];
    row.point_b = x[index_of(b.node)];
    row.normal = pair.memory.normal;
    row.gap = pair.gap;
    row.point = row.point_a + (a.radius + 0.5 * row.gap) * row.normal;
    set_force(row, force_on_b(i, pair));
    row.moment = AnyLaw::moment(pair.memory.history, pair.memory.normal);
    const Parameters of_pair = parameters(i);
    set_state<AnyLaw>(row, of_pair, pair.memory.history,
                      AnyLaw::elastic_normal_force(of_pair, row.gap));
    visit(row);
  });
}

// The state.

void SphereContacts::exchange(const geometry::StateArchive& archive,
                              geometry::FunctionRef<void()> list) {
  blocks_.exchange_order(archive);
  double overlap_ratio = largest_overlap_ratio();
  archive("largest_overlap_ratio", overlap_ratio);
  std::vector<KeptPair> pairs;
  if (archive.is_reading()) {
    keys_.clear();
    list();
    numbers_ = {};
  } else {
    pairs = kept_pairs();
  }
  std::size_t place = 0;
  archive.rows("touching", pairs, [&](geometry::RowFields& row, KeptPair& pair) {
    place = exchange_pair(row, pair, place);
    if (row.is_reading()) keep(pair, place);
    ++place;  // each pair touches once
  });
  if (!archive.is_reading()) return;
  totals_ = {};
  totals_.touching = pairs.size();
  totals_.largest_ratio = overlap_ratio;
}

void SphereContacts::take_over(const SphereContacts& before, std::span<const std::int32_t> places,
                               geometry::FunctionRef<void()> list) {
  keys_.clear();
  list();
  numbers_ = {};
  totals_ = {};
  totals_.largest_ratio = before.largest_overlap_ratio();
  std::size_t place = 0;
  for (KeptPair& pair : before.kept_pairs()) {
    for (std::int32_t& sphere : pair.spheres) sphere = places[static_cast<std::size_t>(sphere)];
    const geometry::IndexPair key{pair.spheres[0], pair.spheres[1]};
    if (key.a < 0 || key.b < 0) continue;
    place = next_place(place, keys_.size(), [&](std::size_t i) { return keys_[i] < key; });
    if (place == keys_.size() || keys_[place] != key) continue;
    require_same_law(pair.state.memory.history, table_.kind(blocks_.slot(place)).law);
    keep(pair, place);
    ++totals_.touching;
  }
}

std::vector<SphereContacts::KeptPair> SphereContacts::kept_pairs() const {
  std::vector<KeptPair> pairs;
  PairNumbers::Reader numbers(numbers_);
  for_each_state([&](std::size_t i, const PairState& pair) {
    const bool is_numbered = table_.is_numbered(blocks_.slot(i));
    pairs.push_back({{keys_[i].a, keys_[i].b}, pair, is_numbered ? numbers.of(keys_[i]) : 0});
  });
  return pairs;
}

/// @param from  place in the list of the pair before
/// @returns the place of this one
std::size_t SphereContacts::exchange_pair(geometry::RowFields& row, KeptPair& pair,
                                          std::size_t from) const {
  row("spheres", pair.spheres);
  const geometry::IndexPair key{pair.spheres[0], pair.spheres[1]};
  const std::size_t place =
      next_place(from, keys_.size(), [&](std::size_t i) { return keys_[i] < key; });
  if (place == keys_.size() || keys_[place] != key) throw_unlisted_contact();
  const PairKind& kind = table_.kind(blocks_.slot(place));
  row("gap", pair.state.gap);
  contact::exchange(row, pair.state.memory, kind.law);
  row("id", pair.id);
  row.numbers("force", pair.state.force.data(), kind.force > 0 ? 3 : 0);
  return place;
}

void SphereContacts::keep(const KeptPair& pair, std::size_t place) {
  const std::uint32_t slot = blocks_.slot(place);
  table_.touched(slot).set_moved(slot % kLanes, true, pair.id != 0);
  if (pair.id != 0) numbers_.add(keys_[place], pair.id);
  if (!table_.holds(slot)) return;
  const PairKind& kind = table_.kind(slot);
  const PairTable::Rows rows = table_.rows(slot);
  table_.set_memory(slot, pair.state.memory);
  rows.from(PairNumbersOfRow::kGap).set(slot % kLanes, pair.state.gap);
  if (kind.force > 0) rows.from(kind.force).set(slot % kLanes, pair.state.force);
}

void SphereContacts::hand_over(const SphereBlocks::Block& block, const SphereWork& work,
                               NodeForces& forces) {
  constexpr std::size_t kAhead = 16;
  const auto owned = blocks_.owned(block);
  const SphereSum* const sums = work.sums.data();
  for (std::size_t m = 0; m < owned.size(); ++m) {
    const std::size_t ahead = index_of(owned[std::min(m + kAhead, owned.size() - 1)].node);
    __builtin_prefetch(&forces.force[ahead], 1);
    __builtin_prefetch(&forces.torque[ahead], 1);
    forces.force[index_of(owned[m].node)] = sums[m].force();
    forces.torque[index_of(owned[m].node)] = sums[m].torque();
  }
  std::copy_n(sums + owned.size(), block.ghosts(), ghost_sums_.begin() + block.first_ghost);
}

void SphereContacts::set_others_zero(NodeForces& forces, geometry::ThreadPool& pool) const {
  if (blocks_.other_nodes().empty()) return;
  pool.for_each_range(forces.force.size(), [&](std::size_t begin, std::size_t end, int) {
    for (const SphereBlocks::NodeRange& range : blocks_.other_nodes()) {
      const std::size_t first = std::max(begin, range.begin);
      const std::size_t last = std::min(end, range.end);
      if (first < last) forces.set_zero(first, last);
    }
  });
}

void SphereContacts::add_ghost_sums(NodeForces& forces, geometry::ThreadPool& pool) const {
  pool.for_each_range(blocks_.blocks().size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t k = begin; k < end; ++k) add_ghost_sums(k, forces);
  });
}

void SphereContacts::add_ghost_sums(std::size_t block, NodeForces& forces) const {
  const auto add = [&](NodeId node, std::size_t ghost) {
    forces.force[index_of(node)] += ghost_sums_[ghost].force();
    forces.torque[index_of(node)] += ghost_sums_[ghost].torque();
  };
  const auto ask = [&](NodeId node, std::size_t ghost) {
    __builtin_prefetch(&ghost_sums_[ghost]);
    __builtin_prefetch(&forces.force[index_of(node)]);
    __builtin_prefetch(&forces.torque[index_of(node)]);
  };
  blocks_.for_each_ghost(block, add, ask);
}

}  // namespace plekton::contact
