// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/sphere_contacts.hpp"

#include "contact/sphere_sphere/move_slots.hpp"
#include "contact/tracking/contact_state.hpp"
#include "contact/tracking/slip_state.hpp"

#include <algorithm>
#include <utility>

namespace plekton::contact {

SphereContacts::Kind::Kind(const AnyLaw::Functions& of, bool keeps) noexcept
    : law(&of), keeps_parameters(keeps) {
  std::size_t rows = PairNumbersOfRow::kHistory + of.history_numbers;
  force = of.force_of_state ? 0 : rows;
  if (force > 0) rows += 3;
  parameters = keeps ? rows : 0;
  if (keeps) rows += of.parameter_numbers;
  row_size = rows * kLanes;
}

/// Numbers are 0 at first: nothing touches.
void SphereContacts::Table::assign(const SphereBlocks& blocks) {
  make_room(places, blocks.row_count());
  places.clear();
  std::size_t line = 0;
  for (const SphereBlocks::Range& range : blocks.ranges()) {
    for (std::uint32_t row = 0; row < range.row_count; ++row) {
      places.push_back({static_cast<std::uint32_t>(line), range.kind});
      line += kinds[range.kind].row_size / kLanes;
    }
  }
  make_room(numbers, line * kLanes);
  numbers.assign(line * kLanes, 0.0);
  make_room(touched, places.size());
  touched.assign(places.size(), {});
}

ContactMemory<AnyLaw> SphereContacts::Table::memory(std::size_t slot) const noexcept {
  const ConstRows of_row = rows(slot);
  ContactMemory<AnyLaw> memory;
  memory.normal = of_row.from(PairNumbersOfRow::kNormal).at<Vec3>(slot % kLanes);
  memory.history.law = kind(slot).law;
  of_row.from(PairNumbersOfRow::kHistory)
      .get_numbers(slot % kLanes, memory.history.numbers.data(), kind(slot).law->history_numbers);
  return memory;
}

void SphereContacts::Table::set_memory(std::size_t slot,
                                       const ContactMemory<AnyLaw>& memory) noexcept {
  const Rows of_row = rows(slot);
  of_row.from(PairNumbersOfRow::kNormal).set(slot % kLanes, memory.normal);
  of_row.from(PairNumbersOfRow::kHistory)
      .set_numbers(slot % kLanes, memory.history.numbers.data(), kind(slot).law->history_numbers);
}

void SphereContacts::Table::resize(std::size_t rows) {
  const std::size_t lines = kinds.front().row_size / kLanes;
  make_room(places, rows);
  make_room(touched, rows);
  make_room(numbers, rows * lines * kLanes);
  for (std::size_t row = places.size(); row < rows; ++row)
    places.push_back({static_cast<std::uint32_t>(row * lines), 0});
  places.resize(rows);
  touched.resize(rows);
  numbers.resize(rows * lines * kLanes, 0.0);
}

double SphereContacts::rebuild(std::span<const geometry::IndexPair> keys,
                               std::span<const SphereBody> spheres, const MaterialPairs& materials,
                               geometry::ThreadPool& pool, Positions x) {
  complete();
  spheres_ = spheres;
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
        lost += forget<AnyLaw>(materials.combine(sphere(keys_[old].a), sphere(keys_[old].b)),
                               memory, {});
      });
  make_room(keys_, keys.size());
  keys_.assign(keys.begin(), keys.end());
  find_kinds(spheres, materials, last_table_.kinds);
  blocks_.assign(keys, spheres, kinds_, pool, x);
  has_owners_ = false;
  if (table_.kinds.size() == 1 && table_.kinds == last_table_.kinds)
    move_memories_in_place();
  else
    move_memories();
  set_parameters(materials);
  return lost;
}

void SphereContacts::share_out(std::span<const NodeId> met) {
  if (!shared_) return;
  if (!has_owners_) shared_->assign(blocks_);
  has_owners_ = true;
  shared_->share_motion(blocks_, met);
}

/// If all spheres are of one material, with nothing said of it as a pair, and the law asks for no
/// more than radii, computing parameters anew takes less time than reading them would.
void SphereContacts::find_kinds(std::span<const SphereBody> spheres, const MaterialPairs& materials,
                                std::vector<Kind>& kinds) {
  kinds.clear();
  kinds_.clear();
  common_.reset();
  if (keys_.empty()) return;
  std::int32_t last = 0;
  for (const geometry::IndexPair& key : keys_) last = std::max(last, key.b);
  const MaterialId first = spheres.front().material;
  if (std::ranges::all_of(spheres.first(static_cast<std::size_t>(last) + 1),
                          [&](const SphereBody& sphere) { return sphere.material == first; })) {
    const AnyLaw::Properties& properties = materials.properties(first, first);
    const bool keeps = !properties.law->combines_radii(properties);
    if (!keeps) common_ = {materials.at(first), properties};
    kinds.emplace_back(*properties.law, keeps);
    return;
  }
  make_room(kinds_, keys_.size());
  for (const geometry::IndexPair& key : keys_) {
    const AnyLaw::Functions* const law =
        materials.properties(sphere(key.a).material, sphere(key.b).material).law;
    auto known = std::ranges::find(kinds, law, &Kind::law);
    if (known == kinds.end()) {
      kinds.emplace_back(*law, true);
      known = kinds.end() - 1;
    }
    kinds_.push_back(static_cast<std::uint8_t>(known - kinds.begin()));
  }
}

void SphereContacts::set_parameters(const MaterialPairs& materials) {
  if (common_) return;
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    const std::uint32_t slot = blocks_.slot(i);
    const Kind& kind = table_.kind(slot);
    table_.rows(slot)
        .from(kind.parameters)
        .set_numbers(slot % kLanes,
                     materials.combine(sphere(keys_[i].a), sphere(keys_[i].b)).numbers.data(),
                     kind.law->parameter_numbers);
  }
}

/// From the slots that pairs had in the list before, to those that they have now.
void SphereContacts::move_memories() {
  std::swap(table_, last_table_);
  table_.assign(blocks_);
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    if (old_slots_[i] == kNoSlot) continue;
    const std::uint32_t from = old_slots_[i], to = blocks_.slot(i);
    table_.set_memory(to, last_table_.memory(from));
    table_.touched[to / kLanes].set_moved(to % kLanes, true, last_table_.is_numbered(from));
  }
}

/// The same of rows of one size: the numbers of a large bed are not there twice.
void SphereContacts::move_memories_in_place() {
  table_.resize(std::max(table_.places.size(), blocks_.row_count()));
  const std::size_t slots = table_.places.size() * kLanes;
  make_room(sources_, slots);
  make_room(is_source_, slots);
  sources_.assign(slots, kNoSlot);
  for (std::size_t i = 0; i < keys_.size(); ++i) sources_[blocks_.slot(i)] = old_slots_[i];
  move_slots(
      sources_, is_source_,
      [this](std::uint32_t slot) {
        return Moved{table_.memory(slot), table_.is_numbered(slot)};
      },
      [this](std::uint32_t slot, const Moved& moved) {
        table_.set_memory(slot, moved.memory);
        table_.touched[slot / kLanes].set_moved(slot % kLanes, !moved.memory.is_new(),
                                                moved.is_numbered);
      });
  table_.resize(blocks_.row_count());
}

/// Of pair i of the list.
SphereContacts::Parameters SphereContacts::parameters(std::size_t i) const noexcept {
  if (common_)
    return AnyLaw::combine(common_->properties, {common_->material, sphere(keys_[i].a).radius},
                           {common_->material, sphere(keys_[i].b).radius});
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
Vec3 SphereContacts::force_on_b(const Touching& pair) const noexcept {
  const Kind& kind = table_.kind(pair.slot);
  if (kind.law->force_of_state)
    return kind.law->force_of_state(pair.parameters, pair.gap, pair.memory.normal,
                                    pair.memory.history);
  return table_.rows(pair.slot).from(kind.force).at<Vec3>(pair.slot % kLanes);
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
  is_complete_ = false;
}

/// Calls visit(owner, first row, end) for the rows of a slice of the blocks of each rank.
template <class Visit>
void SphereContacts::for_each_row_range(std::size_t slice, std::size_t slices,
                                        Visit&& visit) const {
  const auto of_ranks = shared_->blocks_of_ranks();
  for (std::size_t rank = 0; rank < of_ranks.size(); ++rank) {
    const std::vector<std::uint32_t>& all = of_ranks[rank];
    for (std::size_t i = slice * all.size() / slices; i < (slice + 1) * all.size() / slices; ++i) {
      const auto ranges = blocks_.ranges(blocks_.blocks()[all[i]]);
      if (ranges.empty()) continue;
      visit(static_cast<int>(rank), std::size_t{ranges.front().first_row},
            std::size_t{ranges.back().first_row + ranges.back().row_count});
    }
  }
}

/// So many that all numbers of one take about as much room as a message of ranks should.
std::size_t SphereContacts::slices_of_rows() const {
  return 1 + table_.numbers.size() * sizeof(double) / geometry::Ranks::kUsualRoom;
}

/// First which pairs touch, then the rows of those: nobody reads numbers of others. In slices, so
/// that a message is not as large as the scene.
void SphereContacts::complete() const {
  if (is_complete_) return;
  is_complete_ = true;
  const std::size_t slices = slices_of_rows();
  for (std::size_t slice = 0; slice < slices; ++slice) {
    geometry::share(shared_->ranks(), room_, [&](const auto& visit) {
      for_each_row_range(slice, slices, [&](int owner, std::size_t begin, std::size_t end) {
        visit(owner, std::as_writable_bytes(std::span(table_.touched).subspan(begin, end - begin)));
      });
    });
    geometry::share(shared_->ranks(), room_, [&](const auto& visit) {
      for_each_row_range(slice, slices, [&](int owner, std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
          if (!table_.touched[row].any()) continue;
          const std::size_t slot = row * kLanes;
          visit(owner, std::as_writable_bytes(
                           std::span(table_.numbers)
                               .subspan(table_.first_number(slot), table_.kind(slot).row_size)));
        }
      });
    });
  }
}

void SphereContacts::advance_block(const SphereBlocks::Block& block, const Motion& motion,
                                   SphereWork& work) {
  work.spheres.load(blocks_.members(block), motion);
  std::fill_n(work.sums.data(), block.member_count, SphereSum{});
  for (const SphereBlocks::Range& range : blocks_.ranges(block))
    table_.kinds[range.kind].law->advance_spheres(range_of(range), work);
}

SphereRange SphereContacts::range_of(const SphereBlocks::Range& range) noexcept {
  const Kind& kind = table_.kinds[range.kind];
  const std::size_t first = range.first_row;
  return {blocks_.row(first),
          table_.numbers.data() + kLanes * std::size_t{table_.places[first].first_line},
          &table_.touched[first],
          range.row_count,
          kind.row_size,
          kind.force,
          kind.parameters,
          common_ ? &common_->material : nullptr,
          range.was_apart};
}

double SphereContacts::elastic_energy() const {
  double energy = 0.0;
  for_each_lane([&](const Touching& pair) {
    energy += AnyLaw::elastic_normal_energy(pair.parameters, pair.gap) +
              AnyLaw::history_energy(pair.parameters, pair.memory.history);
  });
  return energy;
}

void SphereContacts::assign_ids(std::int64_t& last) {
  complete();
  PairNumbers::Reader known(numbers_);
  PairNumbers numbers;
  for_each_lane([&](const Touching& pair) {
    const bool has_one = table_.is_numbered(pair.slot);
    numbers.add(pair.key, has_one ? known.of(pair.key) : ++last);
  });
  numbers_ = std::move(numbers);
  for (TouchedLanes& touched : table_.touched) touched.set_numbered();
}

void SphereContacts::for_each_record(Positions x, VisitRecord visit) const {
  PairNumbers::Reader numbers(numbers_);
  for_each_lane([&](const Touching& pair) {
    const SphereBody &a = sphere(pair.key.a), &b = sphere(pair.key.b);
    ContactRecord row;
    if (table_.is_numbered(pair.slot)) row.id = numbers.of(pair.key);
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
    require_same_law(pair.memory.history, table_.kind(blocks_.slot(place)).law);
    keep(pair, place);
    ++totals_.touching;
  }
}

std::vector<SphereContacts::KeptPair> SphereContacts::kept_pairs() const {
  std::vector<KeptPair> pairs;
  PairNumbers::Reader numbers(numbers_);
  for_each_lane([&](const Touching& pair) {
    const Kind& kind = table_.kind(pair.slot);
    const bool is_numbered = table_.is_numbered(pair.slot);
    Vec3 force = Vec3::Zero();
    if (kind.force > 0)
      force = table_.rows(pair.slot).from(kind.force).at<Vec3>(pair.slot % kLanes);
    pairs.push_back({{pair.key.a, pair.key.b},
                     pair.gap,
                     pair.memory,
                     force,
                     is_numbered ? numbers.of(pair.key) : 0});
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
  const Kind& kind = table_.kind(blocks_.slot(place));
  row("gap", pair.gap);
  contact::exchange(row, pair.memory, kind.law);
  row("id", pair.id);
  row.numbers("force", pair.force.data(), kind.force > 0 ? 3 : 0);
  return place;
}

void SphereContacts::keep(const KeptPair& pair, std::size_t place) {
  const std::uint32_t slot = blocks_.slot(place);
  const std::size_t lane = slot % kLanes;
  const Kind& kind = table_.kind(slot);
  const Rows rows = table_.rows(slot);
  table_.set_memory(slot, pair.memory);
  rows.from(PairNumbersOfRow::kGap).set(lane, pair.gap);
  if (kind.force > 0) rows.from(kind.force).set(lane, pair.force);
  table_.touched[slot / kLanes].set_moved(lane, true, pair.id != 0);
  if (pair.id != 0) numbers_.add(keys_[place], pair.id);
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
