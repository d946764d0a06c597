// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/pair_term.hpp"

#include "contact/surface_surface/extended.hpp"
#include "contact/surface_surface/nearest.hpp"
#include "contact/surface_surface/rim_share.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace plekton::contact::structure {
namespace {

using geometry::Feature;
using geometry::FeatureKind;

std::array<bool, 3> seams_of(const geometry::Surface& surface, const Feature& feature) {
  if (feature.kind == FeatureKind::node) return {};
  if (feature.kind == FeatureKind::edge) {
    return {!surface.faces_of(geometry::EdgeId{feature.id}).empty(), false, false};
  }
  std::array<bool, 3> is_seam{};
  const auto& edges = surface.edges_of(geometry::FaceId{feature.id});
  for (std::size_t k = 0; k < 3; ++k) is_seam[k] = surface.faces_of(edges[k]).size() > 1;
  return is_seam;
}

/// A facet, or a cylinder that is no side of one.
bool is_cell(const geometry::Surface& surface, const Feature& feature) {
  if (feature.kind == FeatureKind::edge)
    return surface.faces_of(geometry::EdgeId{feature.id}).empty();
  return feature.kind == FeatureKind::face;
}

geometry::Core core_of(const Simplex& simplex) {
  return {simplex.x, simplex.count};
}

Simplex simplex_at(const geometry::FeatureNodes& nodes, const std::array<bool, 3>& is_seam,
                   geometry::Positions x) {
  Simplex simplex;
  simplex.count = nodes.count;
  simplex.is_seam = is_seam;
  for (std::size_t i = 0; i < nodes.count; ++i) simplex.x[i] = x[geometry::index_of(nodes.ids[i])];
  return simplex;
}

/// Of the range. Cores nearer than that meet, up to what matters: the direction is that of the
/// nearest points, wherever they lie side by side.
constexpr double kStructurePair = 1e-6;

/// How far the boxes of two simplices are apart along the axis along which they are furthest apart;
/// negative if they overlap. No points of theirs are nearer.
double gap_of_boxes(const Simplex& a, const Simplex& b) {
  double widest = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    double low_a = a.x[0][k], high_a = low_a, low_b = b.x[0][k], high_b = low_b;
    for (std::size_t i = 1; i < a.count; ++i) {
      low_a = std::min(low_a, a.x[i][k]);
      high_a = std::max(high_a, a.x[i][k]);
    }
    for (std::size_t i = 1; i < b.count; ++i) {
      low_b = std::min(low_b, b.x[i][k]);
      high_b = std::max(high_b, b.x[i][k]);
    }
    widest = std::max(widest, std::max(low_a - high_b, low_b - high_a));
  }
  return widest;
}

/// A point of a core.
struct PointOnCore {
  unsigned corners;  ///< that span it
  const Vec3& weights;
};

/// Finds the same point on a feature of the core; all results are written one by one, as they are
/// read again. @returns whether it lies there
bool find_on(const geometry::FeatureNodes& feature, const geometry::FeatureNodes& core,
             const PointOnCore& point, unsigned& corners, Vec3& weights) {
  corners = 0;
  weights[0] = weights[1] = weights[2] = 0.0;
  for (unsigned rest = point.corners; rest != 0; rest &= rest - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(rest));
    std::size_t place = 0;
    while (place < feature.count && feature.ids[place] != core.ids[k]) ++place;
    if (place == feature.count) return false;
    corners |= 1U << place;
    weights[static_cast<int>(place)] = point.weights[static_cast<int>(k)];
  }
  return true;
}

/// Adds forces a number of times.
void add(const PairForces& from, double times, const PairTerm& term, PairForces& to) {
  to.energy += times * from.energy;
  for (std::size_t i = 0; i < term.a.count; ++i) to.on_a[i] += times * from.on_a[i];
  for (std::size_t i = 0; i < term.b.count; ++i) to.on_b[i] += times * from.on_b[i];
}

}  // namespace

PairTerm pair_term(const geometry::Surface& surface, const geometry::FeaturePair& pair) {
  PairTerm term{};
  term.a = geometry::nodes_of(surface, pair.a);
  term.b = geometry::nodes_of(surface, pair.b);
  term.is_seam_a = seams_of(surface, pair.a);
  term.is_seam_b = seams_of(surface, pair.b);
  term.weight = pair.weight;
  term.is_of_cells = is_cell(surface, pair.a) && is_cell(surface, pair.b);
  term.first_holder = pair.first_holder;
  term.holder_count = pair.holder_count;
  return term;
}

TermProximity proximity(const PairTerm& term, double range, geometry::Positions x, bool was_near,
                        const geometry::closest::WitnessFeatures& last) {
  const Simplex a = simplex_at(term.a, term.is_seam_a, x);
  const Simplex b = simplex_at(term.b, term.is_seam_b, x);
  const geometry::Core core_a = core_of(a), core_b = core_of(b);
  TermProximity found{};
  if (was_near) {  // what was near mostly still is, at the same features
    found.cores = geometry::core_proximity(core_a, core_b, last);
  } else {
    found.clearance = gap_of_boxes(a, b) - range;
    if (found.clearance > 0.0) return found;
    found.cores = geometry::core_proximity(core_a, core_b);
  }
  found.cores = geometry::at_last_touch(core_a, core_b, found.cores);
  found.clearance = found.cores.signed_distance - range;
  found.tilt = -1.0;
  if (found.clearance < 0.0) {
    found.may_be_flat = may_be_flat(a, b, found.cores);
    found.tilt = tilt_between(a, b);
  }
  return found;
}

bool takes_over(const PairTerm& term, const PairTerm& other, Sides sides,
                const TermProximity& of_other, TermProximity& found) {
  const geometry::ClosestPoints& points = of_other.cores.points;
  if (points.relation != geometry::Relation::apart) return false;
  const PointOnCore on_a{points.corners_a, points.weights_a};
  const PointOnCore on_b{points.corners_b, points.weights_b};
  geometry::ClosestPoints& own = found.cores.points;
  if (!find_on(term.a, sides.first(other.a, other.b), sides.first(on_a, on_b), own.corners_a,
               own.weights_a) ||
      !find_on(term.b, sides.second(other.a, other.b), sides.second(on_a, on_b), own.corners_b,
               own.weights_b)) {
    return false;
  }
  own.separation = sides.sign() * points.separation;
  own.distance = points.distance;
  own.relation = points.relation;
  found.cores.normal = sides.sign() * of_other.cores.normal;
  found.cores.signed_distance = of_other.cores.signed_distance;
  found.may_be_flat = of_other.may_be_flat;
  return true;
}

namespace {

/// Of the nearest points, as far as they count.
void add_nearest(const PairTerm& term, const PairForces& nearest, const CoreProximity& points,
                 const PointShare& share, TermForces& to) {
  add(nearest, share.share * term.weight, term, to.forces);
  if (share.share == 1.0) return;
  to.shared = term.weight * nearest.energy;
  add(pushing_apart(points, -to.shared * share.by_distance), 1.0, term, to.forces);
}

}  // namespace

TermForces term_forces(const PairTerm& term, const TermProximity& found, const PointShare& share,
                       const NormalSpring& spring, geometry::Positions x) {
  TermForces result;
  const Simplex a = simplex_at(term.a, term.is_seam_a, x);
  const Simplex b = simplex_at(term.b, term.is_seam_b, x);
  const bool meet = found.cores.signed_distance < kStructurePair * spring.range();
  const PairForces nearest = meet ? at_nearest_points(found.cores, spring)
                                  : nearest_part(a, b, found.cores, found.may_be_flat, spring);
  add_nearest(term, nearest, found.cores, share, result);
  if (!can_extend(a, b)) return result;
  const PairForces extended = extended_part(a, b, spring);
  add(extended, term.weight, term, result.forces);
  if (a.count == 3 && b.count == 3) result.extent = extended;  // of weight 1
  return result;
}

namespace {

/// Bit k: corner k of a facet is among some nodes; 0 if one of these is none of its corners.
unsigned corners_among(const geometry::FeatureNodes& facet, const geometry::FeatureNodes& nodes) {
  unsigned corners = 0;
  std::size_t found = 0;
  for (std::size_t i = 0; i < nodes.count; ++i) {
    for (std::size_t k = 0; k < facet.count; ++k) {
      if (facet.ids[k] != nodes.ids[i]) continue;
      corners |= 1U << k;
      ++found;
    }
  }
  return found == nodes.count ? corners : 0;
}

bool is_rim(const geometry::Surface& surface, geometry::NodeId node) {
  return std::ranges::any_of(surface.edges_of(node), [&](geometry::EdgeId edge) {
    return surface.faces_of(edge).size() == 1;
  });
}

/// Whether the feature that these corners of a facet span is on a rim.
bool is_rim(const geometry::Surface& surface, const geometry::FeatureNodes& facet,
            const std::array<bool, 3>& is_seam, unsigned corners) {
  if (std::popcount(corners) == 1)
    return is_rim(surface, facet.ids[static_cast<std::size_t>(std::countr_zero(corners))]);
  for (std::size_t k = 0; k < 3; ++k)
    if (corners == (1U << k | 1U << (k + 1) % 3)) return !is_seam[k];
  return false;
}

}  // namespace

RimPlaces rim_places(const geometry::Surface& surface, const PairTerm& facets,
                     const geometry::FeatureNodes& a, const geometry::FeatureNodes& b) {
  RimPlaces places{corners_among(facets.a, a), corners_among(facets.b, b)};
  if (places.a == 0 || places.b == 0)
    places = {corners_among(facets.a, b), corners_among(facets.b, a)};
  if (places.a == 0 || places.b == 0) return {};
  if (!is_rim(surface, facets.a, facets.is_seam_a, places.a)) return {};
  if (!is_rim(surface, facets.b, facets.is_seam_b, places.b)) return {};
  return places;
}

Real rim_share(const PairTerm& facets, const RimPlaces& places, geometry::Positions x) {
  return rim_share(simplex_at(facets.a, facets.is_seam_a, x), places.a,
                   simplex_at(facets.b, facets.is_seam_b, x), places.b);
}

void add_tilting(const PairTerm& facets, double by_tilt, geometry::Positions x, PairForces& to) {
  const Simplex a = simplex_at(facets.a, facets.is_seam_a, x);
  const Simplex b = simplex_at(facets.b, facets.is_seam_b, x);
  add(tilting_forces(a, b, by_tilt), 1.0, facets, to);
}

}  // namespace plekton::contact::structure
