// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/nearest.hpp"

#include "contact/surface_surface/facing_facets.hpp"
#include "contact/surface_surface/overlap.hpp"

#include <optional>

namespace plekton::contact::structure {
namespace {

/// Planes up to this sine of their angle are looked at as parallel; beyond it only edges can be.
constexpr double kParallelPlanes = 3.0 * kLargestTilt;

/// An edge of a simplex: its corners k and k + 1.
struct EdgeOf {
  std::size_t side;
  std::size_t first;
  std::size_t last;
};

EdgeOf edge_of(const Simplex& simplex, std::size_t side) {
  return {side, side, (side + 1) % simplex.count};
}
std::size_t edge_count(const Simplex& simplex) {
  return simplex.count == 3 ? 3 : simplex.count - 1;
}

/// Whether the slope of an edge over a plane is certainly beyond kLargestTilt; cheap. The products
/// are within a few eps of their values.
bool is_steep(const Simplex& simplex, const EdgeOf& edge, const Vec3& long_normal) {
  constexpr double kLimit = 1.000001 * kLargestTilt * kLargestTilt;
  const Vec3 along = simplex.x[edge.last] - simplex.x[edge.first];
  const double rise = along.dot(long_normal);
  return rise * rise > kLimit * along.squaredNorm() * long_normal.squaredNorm();
}

double slope_of(const Simplex& simplex, const EdgeOf& edge, const Vec3& normal) {
  const Vec3 along = simplex.x[edge.last] - simplex.x[edge.first];
  return std::abs(along.dot(normal)) / along.norm();
}

bool holds(const EdgeOf& edge, unsigned corners) {
  return (corners & ~(1u << edge.first | 1u << edge.last)) == 0;
}

/// The flattest edge over a facet, of those that hold the nearest point.
struct FlatEdge {
  EdgeOf edge;
  bool is_of_a;
};

void find_flat_edge(const Simplex& simplex, unsigned corners, const Simplex& facet, bool is_of_a,
                    double& least, std::optional<FlatEdge>& found) {
  if (facet.count != 3 || is_needle(facet)) return;
  const Vec3 long_normal = area_normal_of(facet);
  for (std::size_t k = 0; k < edge_count(simplex); ++k) {
    const EdgeOf edge = edge_of(simplex, k);
    if (!holds(edge, corners) || is_steep(simplex, edge, long_normal)) continue;
    const double slope = slope_of(simplex, edge, normal_of(facet));
    if (slope >= least) continue;
    least = slope;
    found = FlatEdge{edge, is_of_a};
  }
}

/// Energy of the nearest points of a cylinder's edge and a side of a facet.
Real of_edge_and_side(const Simplex& simplex, const EdgeOf& edge, Side of_edge,
                      const Simplex& facet, std::size_t first, Side of_facet,
                      const NormalSpring& spring) {
  const std::size_t last = (first + 1) % 3;
  const CoreProximity nearest =
      geometry::core_proximity({{simplex.x[edge.first], simplex.x[edge.last], Vec3::Zero()}, 2},
                               {{facet.x[first], facet.x[last], Vec3::Zero()}, 2});
  Real energy(spring.energy(nearest.signed_distance));
  const Vec3 push = spring.force(nearest.signed_distance) * nearest.normal;
  const auto add = [&](Side side, std::size_t corner, double weight) {
    for (int k = 0; k < 3; ++k)
      energy.slopes[static_cast<int>(side) + 3 * static_cast<int>(corner) + k] += weight * push[k];
  };
  add(of_edge, edge.first, nearest.points.weights_a[0]);
  add(of_edge, edge.last, nearest.points.weights_a[1]);
  add(of_facet, first, -nearest.points.weights_b[0]);
  add(of_facet, last, -nearest.points.weights_b[1]);
  return energy;
}

/// Where the part above the facet ends at a side of it, the cylinder goes on beside it, and what is
/// nearest there if it is tilted that way is nearest to that side. If the side is a seam, that is
/// what the seam takes off and the facet beyond it has too, at its own end there: the three add up
/// to nothing, wherever the cylinder crosses the seam. The place where it does moves as 1 over the
/// angle, and nothing depends on it.
std::optional<PairForces> edge_over_facet(const Simplex& a, const Simplex& b,
                                          const CoreProximity& nearest,
                                          const NormalSpring& spring) {
  std::optional<FlatEdge> flat;
  double least = kLargestTilt;
  find_flat_edge(a, nearest.points.corners_a, b, true, least, flat);
  find_flat_edge(b, nearest.points.corners_b, a, false, least, flat);
  if (!flat) return {};
  const Simplex& simplex = flat->is_of_a ? a : b;
  const Side side = flat->is_of_a ? Side::a : Side::b;
  const Simplex& facet = flat->is_of_a ? b : a;
  const Side other_side = flat->is_of_a ? Side::b : Side::a;
  const auto over = above(corner(simplex, flat->edge.first, side),
                          corner(simplex, flat->edge.last, side), corners(facet, other_side));
  if (!over) return {};
  const Real at_start = share_rising(over->slope);
  const auto energy_at = [&](const Real& place, int at_side) {
    if (at_side < 0) return spring.energy(over->distance(place));
    return of_edge_and_side(simplex, flat->edge, side, facet, static_cast<std::size_t>(at_side),
                            other_side, spring);
  };
  return forces_of(at_start * energy_at(over->part.from, over->sides[0]) +
                   (Real(1.0) - at_start) * energy_at(over->part.to, over->sides[1]));
}

/// Whether an edge may share its nearest point with its ends: free, or the rim of a facet that
/// stands on it.
bool is_bare(const Simplex& simplex, const EdgeOf& edge, const Vec3& normal) {
  if (simplex.is_seam[edge.side]) return false;
  return simplex.count == 2 ||
         (!is_needle(simplex) && normal_of(simplex).cross(normal).norm() >= kParallelPlanes);
}

Real along_edges(const EdgeBesideEdge& edges, const NormalSpring& spring) {
  const Interval& part = edges.part;
  const auto energy_at = [&](const Real& t) { return spring.energy(edges.separation(t).norm()); };
  const Real at_start = share_rising(edges.slope(part.from));
  const Real at_end = share_rising(-edges.slope(part.to));
  const double drift = edges.drift.squaredNorm().value * edges.length.value;
  const double lowest = drift > 0.0 ? -edges.start.dot(edges.drift).value / drift : 0.0;
  // Where the distance is least its derivative by the place is 0 or the place is an end.
  const Real nearest = lowest <= part.from.value ? part.from
                       : lowest >= part.to.value ? part.to
                                                 : Real(lowest);
  return at_start * energy_at(part.from) + at_end * energy_at(part.to) +
         (Real(1.0) - at_start - at_end) * energy_at(nearest);
}

/// Only as far as edges are parallel: the part of one beside another that it crosses at a right
/// angle ends nowhere that is certain, and moves with the angle as 1 / cosine.
std::optional<PairForces> as_far_as_parallel(const Edge& a, const Edge& b,
                                             const CoreProximity& nearest,
                                             const NormalSpring& spring) {
  if (!are_along(a, b)) return {};
  const auto edges = beside(a, b);
  if (!edges) return {};
  const Real share = parallel_share(cosine_between(a, b));
  const PairForces at_point = at_nearest_points(nearest, spring);
  PairForces pair = forces_of(share * (along_edges(*edges, spring) - Real(at_point.energy)));
  pair.energy += at_point.energy;
  for (std::size_t i = 0; i < 3; ++i) {
    pair.on_a[i] += (1.0 - share.value) * at_point.on_a[i];
    pair.on_b[i] += (1.0 - share.value) * at_point.on_b[i];
  }
  return pair;
}

std::optional<PairForces> edge_beside_edge(const Simplex& a, const Simplex& b,
                                           const CoreProximity& nearest,
                                           const NormalSpring& spring) {
  for (std::size_t k = 0; k < edge_count(a); ++k) {
    const EdgeOf of_a = edge_of(a, k);
    if (!holds(of_a, nearest.points.corners_a) || !is_bare(a, of_a, nearest.normal)) continue;
    if (slope_of(a, of_a, nearest.normal) > kLargestTilt) continue;
    for (std::size_t m = 0; m < edge_count(b); ++m) {
      const EdgeOf of_b = edge_of(b, m);
      if (!holds(of_b, nearest.points.corners_b) || !is_bare(b, of_b, nearest.normal)) continue;
      if (slope_of(b, of_b, nearest.normal) > kLargestTilt) continue;
      const auto pair = as_far_as_parallel(
          {corner(a, of_a.first, Side::a), corner(a, of_a.last, Side::a)},
          {corner(b, of_b.first, Side::b), corner(b, of_b.last, Side::b)}, nearest, spring);
      if (pair) return pair;
    }
  }
  return {};
}

}  // namespace

PairForces pushing_apart(const CoreProximity& nearest, double force) {
  PairForces pair;
  for (std::size_t i = 0; i < 3; ++i) {
    pair.on_a[i] = -nearest.points.weights_a[static_cast<int>(i)] * force * nearest.normal;
    pair.on_b[i] = nearest.points.weights_b[static_cast<int>(i)] * force * nearest.normal;
  }
  return pair;
}

PairForces at_nearest_points(const CoreProximity& nearest, const NormalSpring& spring) {
  PairForces pair = pushing_apart(nearest, spring.force(nearest.signed_distance));
  pair.energy = spring.energy(nearest.signed_distance);
  return pair;
}

namespace {

bool may_lie_flat(const Simplex& simplex, unsigned corners, const Simplex& facet) {
  if (facet.count != 3 || is_needle(facet)) return false;
  const Vec3 long_normal = area_normal_of(facet);
  for (std::size_t k = 0; k < edge_count(simplex); ++k) {
    const EdgeOf edge = edge_of(simplex, k);
    if (holds(edge, corners) && !is_steep(simplex, edge, long_normal)) return true;
  }
  return false;
}

}  // namespace

bool may_be_flat(const Simplex& a, const Simplex& b, const CoreProximity& nearest) {
  return (is_cylinder(a) && may_lie_flat(a, nearest.points.corners_a, b)) ||
         (is_cylinder(b) && may_lie_flat(b, nearest.points.corners_b, a));
}

PairForces nearest_part(const Simplex& a, const Simplex& b, const CoreProximity& nearest,
                        bool may_be_flat, const NormalSpring& spring) {
  if (a.count > 1 && b.count > 1 && (is_cylinder(a) || is_cylinder(b))) {
    if (may_be_flat) {
      if (const auto pair = edge_over_facet(a, b, nearest, spring)) return *pair;
    }
    if (const auto pair = edge_beside_edge(a, b, nearest, spring)) return *pair;
  }
  return at_nearest_points(nearest, spring);
}

}  // namespace plekton::contact::structure
