// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/pair_terms.hpp"

#include "contact/surface_surface/nearest.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace plekton::contact::structure {
namespace {

geometry::FeatureNodes some_of(const geometry::FeatureNodes& nodes, unsigned corners) noexcept {
  geometry::FeatureNodes some{nodes.ids, 0};
  for (std::size_t k = 0; k < nodes.count; ++k) {
    if ((corners >> k & 1U) != 0) some.ids[some.count++] = nodes.ids[k];
  }
  return some;
}

/// Whether these are some of the nodes, at least one.
bool are_corners_of(const geometry::FeatureNodes& nodes, unsigned corners) noexcept {
  return corners > 0 && corners < 1U << nodes.count;
}

/// N, how hard the forces of a term push its features apart.
double push_of(const PairTerm& term, const Vec3& normal) {
  double push = 0.0;
  for (std::size_t i = 0; i < term.b.count; ++i) push += term.forces.on_b[i].dot(normal);
  return push;
}

/// Adds what an energy does of which a share depends on how two facets turn.
void add_turning(const Real& share, double energy, PairForces& to) {
  const PairForces turning = forces_of(share);
  for (std::size_t k = 0; k < 3; ++k) {
    to.on_a[k] += energy * turning.on_a[k];
    to.on_b[k] += energy * turning.on_b[k];
  }
}

/// Adds the forces on some nodes to those of a term that has all of them that feel any.
void add_on_nodes(const geometry::FeatureNodes& nodes, const std::array<Vec3, 3>& forces,
                  const PairTerm& term, PairForces& to) {
  for (std::size_t i = 0; i < nodes.count; ++i) {
    for (std::size_t k = 0; k < term.a.count; ++k)
      if (term.a.ids[k] == nodes.ids[i]) to.on_a[k] += forces[i];
    for (std::size_t k = 0; k < term.b.count; ++k)
      if (term.b.ids[k] == nodes.ids[i]) to.on_b[k] += forces[i];
  }
}

}  // namespace

std::array<geometry::FeatureNodes, 2> PairTerms::witness_features(
    std::uint32_t pair) const noexcept {
  const PairTerm& term = terms_[term_of_pair_[pair]];
  const geometry::ClosestPoints& points = proximity_[pair].cores.points;
  const auto a = some_of(term.a, points.corners_a);
  const auto b = some_of(term.b, points.corners_b);
  const Sides sides = holders(term).front().sides;
  return {sides.first(a, b), sides.second(a, b)};
}

void PairTerms::rebuild(
    std::span<const geometry::CellPair> pairs,
    geometry::FunctionRef<std::uint32_t(std::int32_t, std::int32_t)> spring_of) {
  const geometry::ProductFeatures& features = features_.find(*surface_, pairs);
  terms_.clear();
  holders_.clear();
  first_holders_.clear();
  acting_.clear();
  terms_are_new_ = true;
  have_bars_ = false;
  term_of_pair_.resize(pairs.size());
  proximity_.resize(pairs.size());
  tilts_.resize(pairs.size());
  extents_.resize(pairs.size());
  is_near_.assign(pairs.size(), 0);
  cycle_tilts_.assign(pairs.size(), {});
  has_cycle_tilts_ = false;
  clearances_.clear();
  joints_.clear(pairs.size());
  for (const std::uint32_t pair : features.holders) holders_.push_back({pair, {}});
  for (const geometry::FeaturePair& pair : features.pairs) {
    PairTerm term = pair_term(*surface_, pair);
    term.spring = spring_of(static_cast<std::int32_t>(surface_->structure_of(term.a.ids[0])),
                            static_cast<std::int32_t>(surface_->structure_of(term.b.ids[0])));
    for (std::uint32_t h = 0; h < term.holder_count; ++h) {
      Holder& holder = holders_[term.first_holder + h];
      const auto nodes = surface_->nodes_of(pairs[holder.pair].a);
      holder.sides = Sides(std::find(nodes.begin(), nodes.end(), term.a.ids[0]) == nodes.end());
      if (term.is_of_cells) term_of_pair_[holder.pair] = static_cast<std::uint32_t>(terms_.size());
    }
    have_bars_ = have_bars_ || (term.is_of_cells && (term.a.count == 2 || term.b.count == 2));
    first_holders_.push_back(term.first_holder);
    joints_.add(term, {holders_.data() + term.first_holder, term.holder_count}, pairs, *surface_);
    terms_.push_back(term);
  }
  joints_.finish(terms_, term_of_pair_);
  first_holders_.push_back(static_cast<std::uint32_t>(holders_.size()));
  shared_.resize(terms_.size());
  nearest_.resize(terms_.size());
  is_acting_.assign(terms_.size(), 0);
  list_terms_of_pairs();
}

void PairTerms::list_terms_of_pairs() {
  first_terms_.assign(term_of_pair_.size() + 1, 0);
  for (const Holder& holder : holders_) ++first_terms_[holder.pair + 1];
  std::inclusive_scan(first_terms_.begin(), first_terms_.end(), first_terms_.begin());
  terms_of_pairs_.resize(holders_.size());
  next_terms_ = first_terms_;
  for (std::uint32_t i = 0; i < terms_.size(); ++i) {
    for (const Holder& holder : holders(terms_[i])) terms_of_pairs_[next_terms_[holder.pair]++] = i;
  }
}

void PairTerms::evaluate(std::span<const NormalSpring> springs, const Motion& motion,
                         geometry::ThreadPool& pool) {
  if (terms_are_new_) prepare_springs(springs);
  find_near_pairs(springs, motion, pool);
  pool.for_each_shared(near_.size(), [&](std::size_t i, int) {
    evaluate_terms_of(near_[i], springs, motion.position);
  });
  list_acting();
  acting_changed_ = terms_are_new_ || acting_ != acted_;
  if (acting_changed_) parts_.find(in_range(), term_of_pair_.size());
  give_back_of_cycles(springs, motion.position, pool);
  tilt_cells(springs, motion.position, pool);
  joints_.gather(acting_);
  terms_are_new_ = false;
}

/// What there is to know of the springs of this list, whatever others there are.
void PairTerms::prepare_springs(std::span<const NormalSpring> springs) {
  largest_range_ = 0.0;
  bool any_attracts = false;
  for (const PairTerm& term : terms_) {
    largest_range_ = std::max(largest_range_, springs[term.spring].range());
    any_attracts = any_attracts || springs[term.spring].attracts();
  }
  attracts_.clear();
  attractions_.clear();
  if (!any_attracts) return;
  for (const NormalSpring& spring : springs) attracts_.push_back(spring.attracts());
  attractions_.resize(terms_.size());
}

/// m, largest coordinate of a node of a structure: where grains are not every rank knows.
double PairTerms::furthest(Positions x) const {
  double largest = 0.0;
  for (std::size_t n = 0; n < surface_->node_count(); ++n) {
    if (surface_->structure_of(geometry::id_at<NodeId>(n)) != geometry::StructureId{-1})
      largest = std::max(largest, x[n].cwiseAbs().maxCoeff());
  }
  return largest;
}

void PairTerms::find_near_pairs(std::span<const NormalSpring> springs, const Motion& motion,
                                geometry::ThreadPool& pool) {
  const bool is_way_known = motion.max_displacement < std::numeric_limits<double>::infinity();
  if (clearances_.size() == term_of_pair_.size() && is_way_known) {
    clearances_.move(motion.max_displacement);
  } else {
    clearances_.reset(term_of_pair_.size(), furthest(motion.position));
  }
  due_.clear();
  clearances_.for_each_due([&](std::size_t i) { due_.push_back(static_cast<std::uint32_t>(i)); });
  pool.for_each_shared(due_.size(), [&](std::size_t i, int) {
    const std::uint32_t pair = due_[i];
    const PairTerm& term = terms_[term_of_pair_[pair]];
    TermProximity& found = proximity_[pair];
    const geometry::closest::WitnessFeatures last{found.cores.points.corners_a,
                                                  found.cores.points.corners_b};
    found =
        proximity(term, springs[term.spring].range(), motion.position, is_near_[pair] != 0, last);
    clearances_.set(pair, found.clearance);
    is_near_[pair] = found.clearance < 0.0;
    tilts_[pair] = found.tilt;
  });
  near_.clear();
  for (const std::uint32_t pair : due_)
    if (is_near_[pair] != 0) near_.push_back(pair);
}

/// Of those of which a pair in range is the first that has them: a thread that looks at a pair sees
/// to all of it, so that little goes from core to core. Those may be in range that no pair out of
/// range has.
void PairTerms::evaluate_terms_of(std::uint32_t pair, std::span<const NormalSpring> springs,
                                  Positions x) {
  for (const std::uint32_t i : terms_of(pair)) {
    const auto having = holders_of(i);
    if (having.front().pair != pair) continue;
    shared_[i] = {};
    if (std::all_of(having.begin(), having.end(),
                    [&](const Holder& of) { return is_near_[of.pair] != 0; }))
      is_acting_[i] = evaluate_term(i, springs, x);
  }
}

void PairTerms::list_acting() {
  acted_.swap(acting_);
  acting_.clear();
  for (std::uint32_t i = 0; i < is_acting_.size(); ++i) {
    if (is_acting_[i] == 0) continue;
    is_acting_[i] = 0;
    acting_.push_back(i);
  }
}

/// @returns whether it is in range
bool PairTerms::evaluate_term(std::uint32_t i, std::span<const NormalSpring> springs, Positions x) {
  const PairTerm& term = terms_[i];
  const NormalSpring& spring = springs[term.spring];
  if (term.is_of_cells) {
    act(i, proximity_[holders(term).front().pair], spring, x);
    return true;
  }
  TermProximity own;
  for (const Holder& holder : holders(term)) {
    const PairTerm& cells = terms_[term_of_pair_[holder.pair]];
    if (!takes_over(term, cells, holder.sides, proximity_[holder.pair], own)) continue;
    act(i, own, spring, x);
    return true;
  }
  own = proximity(term, spring.range(), x, false, {});
  if (own.clearance < 0.0) act(i, own, spring, x);
  return own.clearance < 0.0;
}

void PairTerms::act(std::uint32_t i, const TermProximity& found, const NormalSpring& spring,
                    Positions x) {
  PairTerm& term = terms_[i];
  term.meets = found.cores.points.relation == geometry::Relation::touching_or_crossing;
  term.overlap = spring.range() - found.cores.signed_distance;
  nearest_[i] = {found.cores.points.corners_a, found.cores.points.corners_b};
  const PointShare share = share_of(term, nearest_[i], spring.range(), x);
  const TermForces pushing = term_forces(term, found, share, spring, x);
  term.point_share = share.share;
  term.forces = pushing.forces;
  term.own_energy = pushing.forces.energy;
  if (term.a.count == 3 && term.b.count == 3) extents_[holders(term).front().pair] = pushing.extent;
  shared_[i][0] = pushing.shared;
  term.push = push_of(term, found.cores.normal);
  term.push += joints_.evaluate(i, term, found, spring, x, false, term.forces);
  if (!spring.attracts()) return;
  const TermForces pulling = term_forces(term, found, share, spring.attraction(), x);
  attractions_[i] = pulling.forces;
  joints_.evaluate(i, term, found, spring.attraction(), x, true, attractions_[i]);
  shared_[i][1] = pulling.shared;
}

PairForces PairTerms::own_forces(std::size_t term, const NormalSpring& spring, Positions x) const {
  const PairTerm& cells = terms_[term];
  const std::uint32_t pair = holders(cells).front().pair;
  const TermProximity& found = proximity_[pair];
  const NearestCorners nearest{found.cores.points.corners_a, found.cores.points.corners_b};
  const PointShare share = share_of(cells, nearest, spring.range(), x);
  auto [forces, extent, shared] = term_forces(cells, found, share, spring, x);
  if (shared == 0.0) return forces;
  const PointShare of = point_share(tilts_[pair], cells.overlap, spring.range());
  const RimPlaces rims = of.share < 1.0 ? rims_of(cells, nearest, pair) : RimPlaces{};
  double beside = 0.0;
  if (rims.a != 0) {
    const Real turning = rim_share(cells, rims, x);
    beside = turning.value;
    add_turning(turning, (1.0 - of.share) * shared, forces);
  }
  add_tilting(cells, (1.0 - beside) * of.by_tilt * shared, x, forces);
  return forces;
}

/// Mean of the pairs of cells that have a term. All of them are in range: their tilts are of now.
PointShare PairTerms::share_of(const PairTerm& term, const NearestCorners& nearest, double range,
                               Positions x) const {
  double share = 0.0, by_distance = 0.0;
  for (const Holder& holder : holders(term)) {
    const PointShare of = point_share(tilts_[holder.pair], term.overlap, range);
    const RimPlaces rims = of.share < 1.0 ? rims_of(term, nearest, holder.pair) : RimPlaces{};
    const double beside = rims.a != 0 ? rim_share(of_cells(holder.pair), rims, x).value : 0.0;
    share += of.share + (1.0 - of.share) * beside;
    by_distance += (1.0 - beside) * of.by_distance;
  }
  const auto count = static_cast<double>(term.holder_count);
  return {share / count, by_distance / count, 0.0};
}

RimPlaces PairTerms::rims_of(const PairTerm& term, const NearestCorners& nearest,
                             std::uint32_t pair) const {
  const PairTerm& cells = of_cells(pair);
  if (cells.a.count != 3 || cells.b.count != 3) return {};
  return rim_places(*surface_, cells, some_of(term.a, nearest.a), some_of(term.b, nearest.b));
}

void PairTerms::give_back_of_cycles(std::span<const NormalSpring> springs, Positions x,
                                    geometry::ThreadPool& pool) {
  if (has_cycle_tilts_) cycle_tilts_.assign(term_of_pair_.size(), {});
  has_cycle_tilts_ = false;
  const double least_life = CycleWeights::kLeastLife * largest_range_;
  for (const std::uint32_t part :
       search_.find(in_range(), parts_, acting_changed_, least_life, pool))
    give_back(part, springs, x);
}

void PairTerms::give_back(std::uint32_t part, std::span<const NormalSpring> springs, Positions x) {
  cycle_pairs_.clear();
  for (const std::uint32_t place : parts_.places(part)) {
    const PairTerm& term = terms_[acting_[place]];
    if (term.is_of_cells) cycle_pairs_.push_back(holders(term).front().pair);
  }
  std::sort(cycle_pairs_.begin(), cycle_pairs_.end());
  const std::span<const std::uint32_t> pairs = cycle_pairs_;
  const NormalSpring& spring = springs[of_cells(pairs.front()).spring];
  const double share = flatness_share(pairs, spring.range());
  // Less would drown in the rounding of what there is.
  if (share < std::numeric_limits<double>::epsilon()) return;
  cycle_cells_.clear();
  for (const std::uint32_t pair : pairs)
    cycle_cells_.push_back({&of_cells(pair).a, &of_cells(pair).b, &proximity_[pair].cores});
  complex_.build(cycle_cells_, spring.range(), x);
  counts_.assign(complex_.levels().distances().size(), 0.0);
  for (const std::uint32_t place : parts_.places(part)) {
    const PairTerm& term = terms_[acting_[place]];
    const std::uint32_t vertex = complex_.vertex_of(term.a, term.b);
    if (vertex != ProductComplex::kNone) counts_[vertex] += term.weight;
  }
  if (!complex_.levels().fillings().empty() && most_cycles() > kMostCycles) return;
  add_cycles(pairs, share, spring, false);
  if (spring.attracts()) add_cycles(pairs, share, spring.attraction(), true);
}

/// Of the part whose counts these are, at any level.
double PairTerms::most_cycles() const noexcept {
  double pieces_less_cycles = 0.0, least = 1.0;
  for (const double count : counts_) least = std::min(least, pieces_less_cycles += count);
  return 1.0 - least;
}

double PairTerms::flatness_share(std::span<const std::uint32_t> pairs,
                                 double range) const noexcept {
  double share = 1.0;
  for (const std::uint32_t pair : pairs)
    share *= point_share(tilts_[pair], of_cells(pair).overlap, range).share;
  return share;
}

/// Spreads what a place does over the pairs of cells that have it.
void PairTerms::add_cycles(std::span<const std::uint32_t> pairs, double share,
                           const NormalSpring& spring, bool pulls) {
  const auto distances = complex_.levels().distances();
  energies_.clear();
  weights_.clear();
  for (std::size_t i = 0; i < distances.size(); ++i) {
    energies_.push_back(spring.energy(distances[i]));
    weights_.push_back(-counts_[i]);
  }
  slopes_.assign(distances.size(), 0.0);
  for (const CycleWeights::Share& of : cycles_.find(complex_.levels(), spring.range(), energies_)) {
    weights_[of.vertex] += of.weight;
    slopes_[of.vertex] = of.slope;
  }
  double whole = 0.0;
  for (std::uint32_t i = 0; i < distances.size(); ++i) {
    if (weights_[i] == 0.0 && slopes_[i] == 0.0) continue;
    const double energy = weights_[i] * energies_[i];
    const double force = share * (weights_[i] * spring.force(distances[i]) + slopes_[i]);
    whole += energy;
    const ProductComplex::Place& place = complex_.place(i);
    const auto having = complex_.holders(i);
    const double part = 1.0 / static_cast<double>(having.size());
    const PairForces forces = pushing_apart(place.cores, part * force);
    for (const std::uint32_t of : having) {
      const std::uint32_t cells = term_of_pair_[pairs[of]];
      PairTerm& term = terms_[cells];
      PairForces& to = pulls ? attractions_[cells] : term.forces;
      to.energy += part * share * energy;
      add_on_nodes(place.a, forces.on_a, term, to);
      add_on_nodes(place.b, forces.on_b, term, to);
      if (!pulls) term.push += part * force;
    }
  }
  if (share != 1.0) add_flatness(pairs, share * whole, spring.range(), pulls);
}

/// What the share of a part does, as it changes with the overlaps and tilts of its pairs.
/// @param energy  J, that it is a factor of
void PairTerms::add_flatness(std::span<const std::uint32_t> pairs, double energy, double range,
                             bool pulls) {
  for (const std::uint32_t pair : pairs) {
    const std::uint32_t cells = term_of_pair_[pair];
    PairTerm& term = terms_[cells];
    const PointShare of = point_share(tilts_[pair], term.overlap, range);
    if (of.share == 1.0) continue;
    const double force = -energy / of.share * of.by_distance;
    const PairForces forces = pushing_apart(proximity_[pair].cores, force);
    PairForces& to = pulls ? attractions_[cells] : term.forces;
    add_on_nodes(term.a, forces.on_a, term, to);
    add_on_nodes(term.b, forces.on_b, term, to);
    if (!pulls) term.push += force;
    cycle_tilts_[pair][pulls ? 1 : 0] += energy / of.share * of.by_tilt;
    has_cycle_tilts_ = true;
  }
}

/// Adds what the rims of two facets beside each other do as they turn.
/// @param energies  J, of which a part lies beside, of attraction in the second
/// @returns that part
double PairTerms::turn_rims(std::uint32_t term, std::uint32_t pair,
                            const std::array<double, 2>& energies, Positions x) {
  const RimPlaces rims = rims_of(terms_[term], nearest_[term], pair);
  if (rims.a == 0) return 0.0;
  const std::uint32_t cells = term_of_pair_[pair];
  const Real share = rim_share(terms_[cells], rims, x);
  add_turning(share, energies[0], terms_[cells].forces);
  if (energies[1] != 0.0) add_turning(share, energies[1], attractions_[cells]);
  return share.value;
}

/// The tilts of pairs of cells turn the nodes of both facets, also those that a term does not have.
/// Each pair adds to its own term alone.
void PairTerms::tilt_cells(std::span<const NormalSpring> springs, Positions x,
                           geometry::ThreadPool& pool) {
  pool.for_each_shared(near_.size(), [&](std::size_t i, int) {
    if (tilts_[near_[i]] >= 0.0) tilt(near_[i], springs, x);
  });
}

void PairTerms::tilt(std::uint32_t pair, std::span<const NormalSpring> springs, Positions x) {
  std::array<double, 2> by_tilt = cycle_tilts_[pair];
  for (const std::uint32_t i : terms_of(pair)) {
    if (is_near_[holders_of(i).front().pair] == 0 || shared_[i] == std::array{0.0, 0.0}) continue;
    const PairTerm& term = terms_[i];
    const double part = 1.0 / static_cast<double>(term.holder_count);
    const PointShare of = point_share(tilts_[pair], term.overlap, springs[term.spring].range());
    const std::array<double, 2> left{part * (1.0 - of.share) * shared_[i][0],
                                     part * (1.0 - of.share) * shared_[i][1]};
    const double beside = of.share < 1.0 ? turn_rims(i, pair, left, x) : 0.0;
    for (std::size_t k = 0; k < 2; ++k)
      by_tilt[k] += part * (1.0 - beside) * of.by_tilt * shared_[i][k];
  }
  const std::uint32_t cells = term_of_pair_[pair];
  const auto [pushing, pulling] = by_tilt;
  if (pushing != 0.0) add_tilting(terms_[cells], pushing, x, terms_[cells].forces);
  if (pulling != 0.0) add_tilting(terms_[cells], pulling, x, attractions_[cells]);
}

void PairTerms::exchange(const geometry::StateArchive& archive) {
  bool is_new = clearances_.size() != term_of_pair_.size();  // no step with this list yet
  archive("is_new", is_new);
  if (archive.is_reading())
    is_new ? clearances_.clear() : clearances_.reset(term_of_pair_.size(), 0.0);
  if (is_new) return;
  clearances_.exchange(archive);
  archive("in_range", acting_);
  archive.require(std::ranges::adjacent_find(acting_, std::greater_equal()) == acting_.end() &&
                      (acting_.empty() || acting_.back() < terms_.size()),
                  "in_range");
  archive.fixed("is_near", is_near_, "pairs of cells");
  for (std::size_t i = 0; i < is_near_.size(); ++i)
    archive.require(is_near_[i] == 0 || clearances_.may_be_within(i, 0.0), "is_near");
  std::vector<std::array<std::uint8_t, 2>> corners(is_near_.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const geometry::ClosestPoints& points = proximity_[i].cores.points;
    if (is_near_[i] != 0)
      corners[i] = {static_cast<std::uint8_t>(points.corners_a),
                    static_cast<std::uint8_t>(points.corners_b)};
  }
  archive.fixed("nearest_corners", corners, "pairs of cells");
  for (std::size_t i = 0; i < corners.size() && archive.is_reading(); ++i) {
    const PairTerm& term = terms_[term_of_pair_[i]];
    archive.require(is_near_[i] == 0 || (are_corners_of(term.a, corners[i][0]) &&
                                         are_corners_of(term.b, corners[i][1])),
                    "nearest_corners");
    proximity_[i].cores.points.corners_a = corners[i][0];
    proximity_[i].cores.points.corners_b = corners[i][1];
  }
}

}  // namespace plekton::contact::structure
