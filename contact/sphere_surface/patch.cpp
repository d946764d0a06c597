// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/patch.hpp"

#include "contact/counting/cycle_weights.hpp"
#include "contact/sphere_surface/near_complex.hpp"
#include "geometry/critical/descent.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace plekton::contact {
namespace {

/// A walk downhill from a saddle in range ends in range, but for the last ulp of the distances:
/// there the overlap of the saddle is nothing but rounding, and the saddle is left out.
constexpr std::uint32_t kOutOfRange = std::numeric_limits<std::uint32_t>::max();

bool nearer(const geometry::CriticalFeature* a, const geometry::CriticalFeature* b) noexcept {
  return a->distance != b->distance ? a->distance < b->distance : a->core.feature < b->core.feature;
}

/// Of a minimum or a saddle.
PatchTerm term_of(const geometry::CriticalFeature& feature, double weight, double share) noexcept {
  return {feature.core, feature.direction,   feature.distance, weight, 0.0, 0.0,
          share,        feature.is_minimum()};
}

/// A force on one node and none on anything else but the sphere.
PatchTerm inner_term(geometry::NodeId node, const Vec3& force) noexcept {
  const double size = force.norm();
  return {geometry::core_point(node), Vec3(force / size), 0.0, 0.0, size, 0.0, 0.0, false, true};
}

}  // namespace

PatchFinder::PatchFinder(const geometry::Surface& surface)
    : surface_(&surface),
      critical_(surface),
      near_(std::make_unique<NearComplex>()),
      cycles_(std::make_unique<CycleWeights>()) {}

PatchFinder::PatchFinder(PatchFinder&&) noexcept = default;
PatchFinder& PatchFinder::operator=(PatchFinder&&) noexcept = default;
PatchFinder::~PatchFinder() = default;

std::span<const Patch> PatchFinder::find(const Vec3& centre, double range,
                                         std::span<const geometry::CellId> cells, Positions x) {
  struct Spring {
    double range;
    double energy(double distance) const { return 0.5 * force(distance) * force(distance); }
    double force(double distance) const { return range - distance; }
  };
  const Spring spring{range};
  return find(centre, range, cells, x, NormalLaw(spring));
}

std::span<const Patch> PatchFinder::find(const Vec3& centre, double range,
                                         std::span<const geometry::CellId> cells, Positions x,
                                         const NormalLaw& law) {
  const std::span<const Critical> critical = critical_.find(centre, range, cells, x);
  find_wraps(centre, range, cells, x, law);
  if (critical.size() <= 1 && wrap_nodes_.empty()) {
    keep_alone(critical);
  } else {
    find_several(critical, centre, range, cells, x, law);
  }
  return patches_;
}

void PatchFinder::find_several(std::span<const Critical> critical, const Vec3& centre, double range,
                               std::span<const geometry::CellId> cells, Positions x,
                               const NormalLaw& law) {
  sort_out(critical);
  link_saddles(centre, x);
  join_parts();
  rooted_.clear();
  if (has_cycles_) {
    add_terms_of_cycles(centre, range, cells, x, law);
  } else {
    add_terms();
  }
  add_terms_of_wraps(centre, x);
  collect_patches();
}

/// Most often there is nothing else in range: what the steps below make of that. A saddle alone, as
/// rounding of the distances may leave it, belongs to no patch.
void PatchFinder::keep_alone(std::span<const Critical> critical) {
  patches_.clear();
  terms_.clear();
  for (const Critical& feature : critical) {
    if (!feature.is_minimum()) continue;
    patches_.push_back({feature.core.feature, 0, 1});
    terms_.push_back(term_of(feature, 1.0, 1.0));
  }
}

void PatchFinder::sort_out(std::span<const Critical> critical) {
  minima_.clear();
  saddles_.clear();
  for (const Critical& feature : critical)
    (feature.is_minimum() ? minima_ : saddles_).push_back(&feature);
  std::sort(minima_.begin(), minima_.end(), nearer);
  std::sort(saddles_.begin(), saddles_.end(), nearer);
}

void PatchFinder::link_saddles(const Vec3& centre, Positions x) {
  number_vertices();
  links_.clear();
  saddle_links_.clear();
  for (auto i = static_cast<std::uint32_t>(minima_.size()); i < vertex_count(); ++i)
    add_links(i, centre, x);
}

/// Takes the numbers of the last call back one by one: a table of all features is as large as the
/// surface.
void PatchFinder::number_vertices() {
  const std::size_t features =
      surface_->node_count() + surface_->edge_count() + surface_->face_count();
  if (vertex_at_.size() == features) {
    for (const std::size_t place : places_) vertex_at_[place] = kOutOfRange;
  } else {
    vertex_at_.assign(features, kOutOfRange);
  }
  places_.clear();
  for (std::uint32_t i = 0; i < vertex_count(); ++i) {
    places_.push_back(place_of(critical_of(i).core.feature));
    vertex_at_[places_.back()] = i;
  }
}

std::size_t PatchFinder::place_of(Feature feature) const noexcept {
  std::size_t first = 0;
  if (feature.kind != geometry::FeatureKind::node) first += surface_->node_count();
  if (feature.kind == geometry::FeatureKind::face) first += surface_->edge_count();
  return first + static_cast<std::size_t>(feature.id);
}

void PatchFinder::add_links(std::uint32_t saddle, const Vec3& centre, Positions x) {
  const Critical& upper = critical_of(saddle);
  const auto first = static_cast<std::uint32_t>(links_.size());
  for (const Feature branch : critical_.branches(upper.core.feature, centre, x)) {
    const std::uint32_t below = vertex_below(branch, centre, x);
    if (below == kOutOfRange) {
      links_.resize(first);
      return;
    }
    links_.push_back({below, saddle});
  }
  saddle_links_.push_back({saddle, first, static_cast<std::uint32_t>(links_.size()) - first});
}

/// The vertex that a foot is; kOutOfRange if it is none.
std::uint32_t PatchFinder::vertex_of(Feature foot) const noexcept {
  return vertex_at_[place_of(foot)];
}

/// The first vertex on the way down.
std::uint32_t PatchFinder::vertex_below(Feature branch, const Vec3& centre, Positions x) const {
  Feature foot = geometry::closest_feature(*surface_, branch, centre, x);
  while (true) {
    if (const std::uint32_t vertex = vertex_of(foot); vertex != kOutOfRange) return vertex;
    const Feature next = geometry::downhill_from(*surface_, foot, centre, x);
    if (next == foot) return kOutOfRange;
    foot = geometry::closest_feature(*surface_, next, centre, x);
  }
}

std::uint32_t PatchFinder::root_of(std::uint32_t vertex) const noexcept {
  while (root_[vertex] != vertex) vertex = root_[vertex];
  return vertex;
}

/// Level by level: which parts hang together, and whether cycles close.
void PatchFinder::join_parts() {
  root_.resize(vertex_count());
  std::iota(root_.begin(), root_.end(), 0U);
  has_cycles_ = false;
  weights_.assign(vertex_count(), 0.0);
  distances_.clear();
  for (std::uint32_t minimum = 0; minimum < minima_.size(); ++minimum) {
    weights_[minimum] = 1.0;
    distances_.push_back(minima_[minimum]->distance);
  }
  merging_.begin(distances_);
  part_ = root_;
  for (const SaddleLinks& saddle : saddle_links_) {
    weights_[saddle.saddle] = 1.0 - critical_of(saddle.saddle).branches;
    for (std::uint32_t i = 0; i < saddle.link_count; ++i) join(links_[saddle.first_link + i]);
  }
  shares_ = merging_.shares();
}

void PatchFinder::join(const Link& link) {
  const auto [low, high] = std::minmax({root_of(link.a), root_of(link.b)});
  has_cycles_ = has_cycles_ || low == high;
  root_[high] = low;
  // The saddle itself is no part; the way to it from any other is that of the first minimum below.
  if (low == high || high >= minima_.size()) return;
  part_[low] = merging_.join(part_[low], part_[high], critical_of(link.b).distance);
}

void PatchFinder::add_terms_of_cycles(const Vec3& centre, double range,
                                      std::span<const geometry::CellId> cells, Positions x,
                                      const NormalLaw& law) {
  near_->build(*surface_, centre, range, cells, x);
  const auto feet = near_->vertices();
  energies_.clear();
  for (const NearComplex::Vertex& foot : feet) energies_.push_back(law.energy(foot.distance));
  const auto shares = cycles_->find(near_->levels(), range, energies_);
  if (shares.empty()) return;
  Feature root = feet.front().core.feature;  // of the piece that was looked at last
  std::uint32_t below = vertex_below(root, centre, x);
  for (const CycleWeights::Share& share : shares) {
    const NearComplex::Vertex& foot = feet[share.vertex];
    const Feature own_root = feet[cycles_->root_of(share.vertex)].core.feature;
    if (own_root != root) below = vertex_below(root = own_root, centre, x);
    if (below == kOutOfRange) continue;
    const std::uint32_t own = vertex_of(foot.core.feature);
    add_term(root_of(below), {foot.core, foot.normal, foot.distance, share.weight, share.slope, 0.0,
                              share_of(own), own < minima_.size()});
  }
}

/// Of the nodes that are owned by cells in range: each once. Nodes of facets give nothing back.
void PatchFinder::find_wraps(const Vec3& centre, double range,
                             std::span<const geometry::CellId> cells, Positions x,
                             const NormalLaw& law) {
  wrap_terms_.clear();
  wrap_nodes_.clear();
  for (const geometry::CellId cell : cells) {
    if (index_of(cell) < surface_->face_count()) continue;
    for (const geometry::NodeId node : surface_->nodes_of(cell)) {
      if (surface_->owner_of(node) != cell || !surface_->faces_of(node).empty()) continue;
      const std::size_t first = wrap_terms_.size();
      find_wrap(node, centre, range, x, law);
      if (wrap_terms_.size() > first) wrap_nodes_.push_back({node, first, wrap_terms_.size()});
    }
  }
}

/// A node pushes along its own normal, and beside that there are forces between it and the ends of
/// its bars.
void PatchFinder::find_wrap(geometry::NodeId node, const Vec3& centre, double range, Positions x,
                            const NormalLaw& law) {
  const Vec3& at = x[index_of(node)];
  const Vec3 separation = at - centre;
  if (!(separation.squaredNorm() < range * range)) return;
  arms_.clear();
  arm_ends_.clear();
  for (const geometry::EdgeId edge : surface_->edges_of(node)) {
    const auto& ends = surface_->nodes_of(edge);
    arm_ends_.push_back(ends[0] == node ? ends[1] : ends[0]);
    arms_.emplace_back().bar = x[index_of(arm_ends_.back())] - at;
  }
  const WrapShare wrap = wrap_share(separation, range, arms_);
  if (!(wrap.contacts > 0.0)) return;
  const double distance = separation.norm();
  const Vec3 normal = separation / distance;
  const double energy = law.energy(distance);
  Vec3 beside = -energy * wrap.by_separation;  // N, on the node, what changes of shares do
  for (std::size_t i = 0; i < arms_.size(); ++i) {
    const Vec3 on_end = -energy * arms_[i].by_bar;
    beside -= on_end;
    if (!on_end.isZero(0.0)) wrap_terms_.push_back(inner_term(arm_ends_[i], on_end));
  }
  const double slope = beside.dot(normal);
  const Vec3 aside = beside - slope * normal;
  if (!aside.isZero(0.0)) wrap_terms_.push_back(inner_term(node, aside));
  wrap_terms_.push_back(
      {geometry::core_point(node), normal, distance, wrap.contacts, slope, 0.0, 0.0, false});
}

void PatchFinder::add_terms_of_wraps(const Vec3& centre, Positions x) {
  for (const NodeTerms& node : wrap_nodes_) {
    const std::uint32_t below = vertex_below(Feature(node.node), centre, x);
    if (below == kOutOfRange) continue;
    for (std::size_t i = node.first; i < node.end; ++i) add_term(root_of(below), wrap_terms_[i]);
  }
}

void PatchFinder::add_terms() {
  for (std::uint32_t vertex = 0; vertex < vertex_count(); ++vertex) {
    if (weights_[vertex] != 0.0)
      add_term(root_of(vertex), term_of(critical_of(vertex), weights_[vertex], share_of(vertex)));
  }
}

void PatchFinder::add_term(std::uint32_t root, const PatchTerm& term) {
  if (root < minima_.size())
    rooted_.push_back({root, static_cast<std::uint32_t>(rooted_.size()), term});
}

void PatchFinder::collect_patches() {
  // minima_ is sorted by distance and a root is the lowest of its vertices: the root's minimum is
  // the deepest one.
  const auto root_feature = [this](const RootedTerm& rooted) {
    return minima_[rooted.root]->core.feature;
  };
  const auto comes_before = [&](const RootedTerm& a, const RootedTerm& b) {
    return a.root != b.root ? root_feature(a) < root_feature(b) : a.order < b.order;
  };
  if (!std::is_sorted(rooted_.begin(), rooted_.end(), comes_before))
    std::sort(rooted_.begin(), rooted_.end(), comes_before);
  patches_.clear();
  terms_.clear();
  for (const RootedTerm& rooted : rooted_) {
    const Feature root = root_feature(rooted);
    if (patches_.empty() || patches_.back().root != root) {
      patches_.push_back({root, static_cast<std::uint32_t>(terms_.size()), 0});
    }
    terms_.push_back(rooted.term);
    ++patches_.back().term_count;
  }
}

}  // namespace plekton::contact
