// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/sphere_contacts.hpp"

#include "contact/sphere_sphere/move_slots.hpp"
#include "contact/tracking/contact_state.hpp"
#include "contact/tracking/slip_state.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace plekton::contact {

double SphereContacts::rebuild(std::span<const geometry::IndexPair> pairs,
                               std::span<const SphereBody> spheres, const MaterialPairs& materials,
                               geometry::ThreadPool& pool, Positions x) {
  const bool were_shared_out = is_shared_out();
  spheres_ = spheres;
  materials_ = &materials;
  std::vector<geometry::IndexPair> own;
  if (has_ranks()) pairs = own = shared_->deal_out(pairs, spheres, x, blocks_);
  find_old_slots(pairs);
  std::vector<KeptPair> moved = dealt_out(kept(left_), were_shared_out);
  if (has_ranks()) {
    keys_ = std::move(own);
  } else {
    make_room(keys_, pairs.size());
    keys_.assign(pairs.begin(), pairs.end());
  }
  find_kinds();
  if (has_ranks())
    shared_->fill(keys_, spheres, kinds_, pool, x, blocks_);
  else
    blocks_.assign(keys_, spheres, kinds_, pool, x);
  table_.take(blocks_, kinds_of_list_, old_slots_);
  set_parameters();
  return take_dealt_out(std::move(moved));
}

/// Of those that touch.
void SphereContacts::find_old_slots(std::span<const geometry::IndexPair> keys) {
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
}

/// @param places  ascending
std::vector<SphereContacts::KeptPair> SphereContacts::kept(
    std::span<const std::uint32_t> places) const {
  PairNumbers::Reader numbers(numbers_);
  std::vector<KeptPair> pairs;
  for (const std::uint32_t i : places) pairs.push_back(kept_pair(i, numbers));
  return pairs;
}

/// What touches and has left the list of this rank goes to the rank on whose list it would be; to
/// all, with whatever touches, where all have all pairs from now on.
/// @param left  in order
/// @returns what is to be found on this rank's new list, or is lost
std::vector<SphereContacts::KeptPair> SphereContacts::dealt_out(std::vector<KeptPair> left,
                                                                bool were_shared_out) const {
  if (!has_ranks() || (!were_shared_out && !is_shared_out())) return left;
  if (!were_shared_out) {
    std::erase_if(left, [this](const KeptPair& pair) { return is_of_other_rank(pair.key()); });
    return left;
  }
  std::vector<KeptPair> pairs;
  if (is_shared_out()) {
    pairs = geometry::dealt_out(
                shared_->ranks(), std::span<const KeptPair>(left),
                [this](const KeptPair& pair) { return shared_->rank_of(pair.key(), blocks_); })
                .things;
  } else {
    std::vector<std::uint32_t> touching;
    for (std::uint32_t i = 0; i < keys_.size(); ++i)
      if (table_.has_touched(blocks_.slot(i))) touching.push_back(i);
    const std::vector<KeptPair> own = kept(touching);
    pairs = geometry::told_to_all(shared_->ranks(), std::span<const KeptPair>(own)).things;
  }
  std::ranges::sort(pairs, {}, &KeptPair::key);
  for (KeptPair& pair : pairs) pair.memory.history.law = &law_of(pair.key());
  return pairs;
}

/// @param pairs  in order
/// @returns the energy (J) lost with those that are not on the list
double SphereContacts::take_dealt_out(std::vector<KeptPair> pairs) {
  PairNumbers numbers;
  std::vector<ToldPair<double>> lost;
  std::size_t place = 0;
  for (KeptPair& pair : pairs) {
    const geometry::IndexPair key = pair.key();
    place = place_of(key, place);
    if (place == keys_.size() || keys_[place] != key) {
      const Parameters of_pair = materials_->combine(sphere(key.a), sphere(key.b));
      lost.push_back({key, forget<AnyLaw>(of_pair, pair.memory, {})});
    } else if (!table_.has_touched(blocks_.slot(place))) {
      keep(pair, place);
      if (pair.id != 0) numbers.add(key, pair.id);
    }
  }
  numbers_.merge(std::move(numbers));
  return sum_of_lost(std::move(lost));
}

/// In the order of the pairs, whichever rank has them.
double SphereContacts::sum_of_lost(std::vector<ToldPair<double>> lost) const {
  double sum = 0.0;
  const auto add = [&](const ToldPair<double>& pair, int) { sum += pair.told; };
  if (is_shared_out())
    visit_in_order(geometry::told_to_all(shared_->ranks(), std::span<const ToldPair<double>>(lost)),
                   add);
  else
    for (const ToldPair<double>& pair : lost) add(pair, 0);
  return sum;
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
  const std::size_t spheres = has_ranks() ? blocks_.sphere_count() : spheres_in(keys_);
  if (spheres == 0) return;
  const MaterialId first = spheres_.front().material;
  if (std::ranges::all_of(spheres_.first(spheres),
                          [&](const SphereBody& sphere) { return sphere.material == first; })) {
    const AnyLaw::Properties& properties = materials_->properties(first, first);
    const bool keeps = !properties.law->combines_radii(properties);
    if (!keeps) common_ = {materials_->at(first), properties};
    kinds.emplace_back(*properties.law, keeps);
    return;
  }
  std::vector<geometry::IndexPair> firsts;
  make_room(kinds_, keys_.size());
  for (const geometry::IndexPair& key : keys_) {
    const AnyLaw::Functions* const law = &law_of(key);
    auto known = std::ranges::find(kinds, law, &PairKind::law);
    if (known == kinds.end()) {
      kinds.emplace_back(*law, true);
      known = kinds.end() - 1;
      if (is_shared_out()) firsts.push_back(key);
    }
    kinds_.push_back(static_cast<std::uint8_t>(known - kinds.begin()));
  }
  if (is_shared_out()) agree_on_kinds(std::move(firsts));
}

/// Kinds come in the order of their first pairs, on whichever rank these are.
/// @param firsts  pairs of this rank, by kind
void SphereContacts::agree_on_kinds(std::vector<geometry::IndexPair> firsts) {
  std::vector<PairKind>& kinds = kinds_of_list_;
  const std::vector<PairKind> own = std::exchange(kinds, {});
  firsts =
      geometry::told_to_all(shared_->ranks(), std::span<const geometry::IndexPair>(firsts)).things;
  std::ranges::sort(firsts);
  for (const geometry::IndexPair& key : firsts) {
    const AnyLaw::Functions& law = law_of(key);
    if (std::ranges::find(kinds, &law, &PairKind::law) == kinds.end())
      kinds.emplace_back(law, true);
  }
  std::vector<std::uint8_t> now;
  for (const PairKind& kind : own)
    now.push_back(static_cast<std::uint8_t>(std::ranges::find(kinds, kind) - kinds.begin()));
  for (std::uint8_t& kind : kinds_) kind = now[kind];
}

void SphereContacts::set_parameters() {
  if (common_) return;
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    const std::uint32_t slot = blocks_.slot(i);
    const PairKind& kind = table_.kind(slot);
    table_.rows(slot)
        .from(kind.parameters)
        .set_numbers(slot % kLanes,
                     materials_->combine(sphere(keys_[i].a), sphere(keys_[i].b)).numbers.data(),
                     kind.law->parameter_numbers);
  }
}

/// @param place  in the list, or kElsewhere
SphereContacts::Parameters SphereContacts::parameters(const geometry::IndexPair& pair,
                                                      std::size_t place) const noexcept {
  if (common_)
    return AnyLaw::combine(common_->properties, {common_->material, sphere(pair.a).radius},
                           {common_->material, sphere(pair.b).radius});
  if (place == kElsewhere) return materials_->combine(sphere(pair.a), sphere(pair.b));
  const std::uint32_t slot = blocks_.slot(place);
  const PairKind& kind = table_.kind(slot);
  Parameters kept;
  kept.law = kind.law;
  table_.rows(slot)
      .from(kind.parameters)
      .get_numbers(slot % kLanes, kept.numbers.data(), kind.law->parameter_numbers);
  return kept;
}

SphereContacts::KeptPair SphereContacts::kept_pair(std::size_t i,
                                                   PairNumbers::Reader& numbers) const {
  const std::uint32_t slot = blocks_.slot(i);
  KeptPair pair{{keys_[i].a, keys_[i].b}, 0, table_.gap(slot), table_.memory(slot)};
  if (table_.is_numbered(slot)) pair.id = numbers.of(keys_[i]);
  const PairKind& kind = table_.kind(slot);
  if (kind.force > 0) pair.force = table_.rows(slot).from(kind.force).at<Vec3>(slot % kLanes);
  return pair;
}

/// N, of the last step.
Vec3 SphereContacts::force_on_b(const KeptPair& pair, const Parameters& parameters) const noexcept {
  const AnyLaw::Functions& law = *pair.memory.history.law;
  if (!law.force_of_state) return pair.force;
  return law.force_of_state(parameters, pair.gap, pair.memory.normal, pair.memory.history);
}

std::optional<double> SphereContacts::gap_of_touching(std::size_t i) const noexcept {
  const std::uint32_t slot = blocks_.slot(i);
  return table_.has_touched(slot) ? std::optional(table_.gap(slot)) : std::nullopt;
}

std::optional<double> SphereContacts::gap_of_near(std::size_t i, double margin,
                                                  Positions x) const noexcept {
  const SphereBody &a = sphere(keys_[i].a), &b = sphere(keys_[i].b);
  const double touch = a.radius + b.radius;
  double range = touch + margin;
  if (materials_->may_act_at_a_distance())
    range += AnyLaw::interaction_range(parameters(keys_[i], i));
  const double squared = (x[index_of(b.node)] - x[index_of(a.node)]).squaredNorm();
  return squared < range * range ? std::optional(std::sqrt(squared) - touch) : std::nullopt;
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
      [this](std::size_t i) -> std::optional<double> {
        const std::uint32_t slot = blocks_.slot(i);
        if (!table_.has_touched(slot)) return std::nullopt;
        const Parameters of_pair = parameters(keys_[i], i);
        return AnyLaw::elastic_normal_energy(of_pair, table_.gap(slot)) +
               AnyLaw::history_energy(of_pair, table_.memory(slot).history);
      },
      [&](const geometry::IndexPair&, std::size_t, double of_pair) { energy += of_pair; });
  return energy;
}

void SphereContacts::assign_ids(std::int64_t& last) {
  PairNumbers::Reader known(numbers_);
  PairNumbers numbers;
  for_each_told<std::int64_t>(
      [&](std::size_t i) -> std::optional<std::int64_t> {
        const std::uint32_t slot = blocks_.slot(i);
        if (!table_.has_touched(slot)) return std::nullopt;
        return table_.is_numbered(slot) ? known.of(keys_[i]) : 0;
      },
      [&](const geometry::IndexPair& pair, std::size_t place, std::int64_t number) {
        if (number == 0) number = ++last;
        if (place != kElsewhere) numbers.add(pair, number);
      });
  numbers_ = std::move(numbers);
  table_.set_numbered();
}

void SphereContacts::for_each_record(Positions x, VisitRecord visit) const {
  for_each_kept([&](const KeptPair& pair, std::size_t place) {
    const geometry::IndexPair key = pair.key();
    const SphereBody &a = sphere(key.a), &b = sphere(key.b);
    const Parameters of_pair = parameters(key, place);
    ContactRecord row;
    row.id = pair.id;
    row.a = {BodyKind::sphere, key.a, geometry::Feature(a.node)};
    row.b = {BodyKind::sphere, key.b, geometry::Feature(b.node)};
    row.point_a = x[index_of(a.node)];
    row.point_b = x[index_of(b.node)];
    row.normal = pair.memory.normal;
    row.gap = pair.gap;
    row.point = row.point_a + (a.radius + 0.5 * row.gap) * row.normal;
    set_force(row, force_on_b(pair, of_pair));
    row.moment = AnyLaw::moment(pair.memory.history, pair.memory.normal);
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
  geometry::IndexPair last{-1, -1};
  bool is_unlisted = false;
  archive.rows("touching", pairs, [&](geometry::RowFields& row, KeptPair& pair) {
    exchange_pair(row, pair);
    if (!row.is_reading()) return;
    const geometry::IndexPair key = pair.key();
    is_unlisted = is_unlisted || !(last < key);
    last = key;
    if (is_unlisted || is_of_other_rank(key)) return;
    place = place_of(key, place);
    if (place == keys_.size() || keys_[place] != key) {
      is_unlisted = true;
      return;
    }
    if (pair.id != 0) numbers_.add(key, pair.id);
    keep(pair, place);
  });
  if (!archive.is_reading()) return;
  if (is_true_anywhere(is_unlisted)) throw_unlisted_contact();
  totals_ = {};
  totals_.touching = pairs.size();
  totals_.largest_ratio = overlap_ratio;
}

void SphereContacts::take_over(const SphereContacts& before, std::span<const std::int32_t> places,
                               geometry::FunctionRef<void()> list) {
  keys_.clear();
  list();
  numbers_ = {};
  bool had_other_law = false;
  std::uint64_t touching = 0;
  std::size_t place = 0;
  for (KeptPair& pair : before.kept_pairs()) {
    for (std::int32_t& sphere : pair.spheres) sphere = places[static_cast<std::size_t>(sphere)];
    const geometry::IndexPair key = pair.key();
    if (key.a < 0 || key.b < 0 || is_of_other_rank(key)) continue;
    place = place_of(key, place);
    if (place == keys_.size() || keys_[place] != key) continue;
    if (is_other_law(pair.memory.history, &law_of(key))) {
      had_other_law = true;
      continue;
    }
    if (pair.id != 0) numbers_.add(key, pair.id);
    keep(pair, place);
    ++touching;
  }
  if (is_true_anywhere(had_other_law)) throw_other_law();
  if (is_shared_out()) {
    const std::vector<std::uint64_t> of_ranks = told_by_each(shared_->ranks(), touching);
    touching = std::accumulate(of_ranks.begin(), of_ranks.end(), std::uint64_t{0});
  }
  totals_ = {};
  totals_.touching = touching;
  totals_.largest_ratio = before.largest_overlap_ratio();
}

std::vector<SphereContacts::KeptPair> SphereContacts::kept_pairs() const {
  std::vector<KeptPair> pairs;
  for_each_kept([&](const KeptPair& pair, std::size_t) { pairs.push_back(pair); });
  return pairs;
}

/// @param from  place of a pair before it
/// @returns where in the list it is, if it is there
std::size_t SphereContacts::place_of(const geometry::IndexPair& key, std::size_t from) const {
  return next_place(from, keys_.size(), [&](std::size_t i) { return keys_[i] < key; });
}

/// What only the rank that has a pair can see, all have to fail of.
bool SphereContacts::is_true_anywhere(bool is_true_here) const {
  return is_shared_out() ? any_rank(shared_->ranks(), is_true_here) : is_true_here;
}

bool SphereContacts::is_of_other_rank(const geometry::IndexPair& key) const {
  return is_shared_out() && shared_->rank_of(key, blocks_) != shared_->ranks().rank();
}

void SphereContacts::exchange_pair(geometry::RowFields& row, KeptPair& pair) const {
  row("spheres", pair.spheres);
  const auto is_a_sphere = [this](std::int32_t i) {
    return i >= 0 && static_cast<std::size_t>(i) < spheres_.size();
  };
  if (!std::ranges::all_of(pair.spheres, is_a_sphere)) throw_unlisted_contact();
  const AnyLaw::Functions& law = law_of(pair.key());
  row("gap", pair.gap);
  contact::exchange(row, pair.memory, &law);
  row("id", pair.id);
  row.numbers("force", pair.force.data(), law.force_of_state ? 0 : 3);
}

/// Of a pair that touches, and was not known to.
void SphereContacts::keep(const KeptPair& pair, std::size_t place) {
  const std::uint32_t slot = blocks_.slot(place);
  table_.touched(slot).set_moved(slot % kLanes, true, pair.id != 0);
  const PairKind& kind = table_.kind(slot);
  const PairTable::Rows rows = table_.rows(slot);
  table_.set_memory(slot, pair.memory);
  rows.from(PairNumbersOfRow::kGap).set(slot % kLanes, pair.gap);
  if (kind.force > 0) rows.from(kind.force).set(slot % kLanes, pair.force);
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
