// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/extended.hpp"

#include "contact/surface_surface/facing_facets.hpp"
#include "contact/surface_surface/overlap.hpp"

#include <utility>

namespace plekton::contact::structure {
namespace {

Real magnitude(const Real& x) {
  return x.value < 0.0 ? -x : x;
}

/// Above the interior of the facet, or below it.
Real of_edge_above_facet(const Vector& first, const Vector& last,
                         const std::array<Vector, 3>& facet, const NormalSpring& spring) {
  auto over = above(first, last, facet);
  if (!over) return {0.0};
  const Real range(spring.range());
  if (!cut(over->part, range - over->first, range - over->last)) return {0.0};
  if (!cut(over->part, range + over->first, range + over->last)) return {0.0};
  const Interval& part = over->part;
  const Real middle = 0.5 * (part.from + part.to);
  // Simpson's rule: exact for a linear spring, but where the edge crosses the facet.
  const auto energy_at = [&](const Real& t) { return spring.energy(magnitude(over->distance(t))); };
  const Real sum = energy_at(part.from) + 4.0 * energy_at(middle) + energy_at(part.to);
  // Cosine to second order of the slope, so that a level cylinder has a derivative.
  const Real cosine = Real(1.0) - 0.5 * over->slope * over->slope;
  return parallel_share(cosine) * over->length * (part.to - part.from) *
         (1.0 / (6.0 * spring.range())) * sum;
}

/// A stretch on which two straight lines have a separation start + place * drift.
struct Stretch {
  Real from;
  Real to;
  Vector start;
  Vector drift;
};

/// Keeps what is nearer than range. @returns whether anything is left
bool cut_to_range(Stretch& stretch, double range) {
  const Real quadratic = stretch.drift.squaredNorm();
  const Real half_linear = stretch.start.dot(stretch.drift);
  const Real constant = stretch.start.squaredNorm() - Real(range * range);
  const double length = (stretch.to - stretch.from).value;
  if (quadratic.value * length * length < 1e-24 * range * range) return constant.value < 0.0;
  const Real discriminant = half_linear * half_linear - quadratic * constant;
  if (discriminant.value <= 0.0) return false;
  const Real root = geometry::square_root(discriminant);
  const Real enters = (-half_linear - root) / quadratic;
  const Real leaves = (-half_linear + root) / quadratic;
  if (enters > stretch.from) stretch.from = enters;
  if (leaves < stretch.to) stretch.to = leaves;
  return stretch.from < stretch.to;
}

/// Integral of the energy over the part of a stretch in range. Gauss-Legendre with 5 points,
/// Abramowitz & Stegun (1964), table 25.4.
Real integral(Stretch stretch, const NormalSpring& spring) {
  if (!cut_to_range(stretch, spring.range())) return {0.0};
  constexpr std::array<double, 5> kPlaces{-0.9061798459386640, -0.5384693101056831, 0.0,
                                          0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 5> kWeights{0.2369268850561891, 0.4786286704993665,
                                           0.5688888888888889, 0.4786286704993665,
                                           0.2369268850561891};
  const Real half = 0.5 * (stretch.to - stretch.from);
  const Real middle = 0.5 * (stretch.to + stretch.from);
  Real sum(0.0);
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    const Real place = middle + kPlaces[i] * half;
    sum = sum + kWeights[i] * spring.energy((stretch.start + place * stretch.drift).norm());
  }
  return half * sum;
}

/// Whether an edge is out of range of the line of another for certain; cheap.
bool is_far_from_line(const Edge& edge, const Edge& other, double range) {
  const auto origin = now(other[0]);
  const auto along = unit(now(other[1]) - origin);
  const auto across = [&](const Vector& point) {
    const auto from_line = now(point) - origin;
    return from_line - from_line.dot(along) * along;
  };
  const auto first = across(edge[0]), last = across(edge[1]);
  return first.norm() - (last - first).norm() > 1.000001 * range;
}

/// A cylinder beside the side of a facet, integrated along the cylinder.
/// @param facet  which it is a side of: only where the cylinder lies beyond it; nullptr: everywhere
Real of_cylinder_beside_side(const Edge& cylinder, const Edge& side, const NormalSpring& spring,
                             const std::array<Vector, 3>* facet) {
  if (!are_along(cylinder, side) || is_far_from_line(cylinder, side, spring.range())) return {0.0};
  auto edges = beside(cylinder, side);
  if (!edges) return {0.0};
  if (facet != nullptr) {
    const auto& [p, q, r] = *facet;
    const Vector outward = (side[1] - side[0]).cross((q - p).cross(r - p));
    if (lies_in_plane(cylinder[0], cylinder[1], side[0], outward)) return {0.0};
    if (!cut(edges->part, cylinder[0], cylinder[1], side[0], outward)) return {0.0};
  }
  const Stretch stretch{edges->length * edges->part.from, edges->length * edges->part.to,
                        edges->start, edges->drift};
  return parallel_share(cosine_between(cylinder, side)) * integral(stretch, spring) *
         Real(1.0 / spring.range());
}

/// Every point of the cylinder pushes where it is nearest to the facet: inside, or on a side.
Real of_cylinder_and_facet(const Edge& cylinder, const std::array<Vector, 3>& facet,
                           const NormalSpring& spring) {
  Real energy = of_edge_above_facet(cylinder[0], cylinder[1], facet, spring);
  for (std::size_t k = 0; k < 3; ++k) {
    const Edge side{facet[k], facet[(k + 1) % 3]};
    energy = energy + of_cylinder_beside_side(cylinder, side, spring, &facet);
  }
  return energy;
}

/// Two cylinders, integrated along the mean of their directions.
Real of_cylinders(const Edge& a, Edge b, const NormalSpring& spring) {
  if (!are_along(a, b)) return {0.0};
  if ((a[1] - a[0]).dot(b[1] - b[0]).value < 0.0) std::swap(b[0], b[1]);
  const Vector along_a = unit(a[1] - a[0]);
  const Vector along_b = unit(b[1] - b[0]);
  const Vector mean = unit(along_a + along_b);
  const Real half_cosine = along_a.dot(mean);
  const Real end_a = (a[1] - a[0]).dot(mean);
  const Real start_b = (b[0] - a[0]).dot(mean);
  const Real end_b = (b[1] - a[0]).dot(mean);
  Stretch stretch;
  // At a tie b's end rules: what a chain of cylinders on a has, its pieces have in turn.
  stretch.from = start_b.value >= 0.0 ? start_b : Real(0.0);
  stretch.to = end_b.value <= end_a.value ? end_b : end_a;
  if (!(stretch.from < stretch.to)) return {0.0};
  stretch.drift = (Real(1.0) / half_cosine) * (along_b - along_a);
  stretch.start = (b[0] - a[0]) - (start_b / half_cosine) * along_b;
  return parallel_share(cosine_between(a, b)) * integral(stretch, spring) *
         Real(1.0 / spring.range());
}

Edge ends(const Simplex& edge, Side side) {
  return {corner(edge, 0, side), corner(edge, 1, side)};
}

/// Beside a cylinder a needle is its longest side: the seams on both sides of it still cancel.
Real of_cylinder_and_face(const Edge& cylinder, const Simplex& face, Side side,
                          const NormalSpring& spring) {
  if (!is_needle(face)) return of_cylinder_and_facet(cylinder, corners(face, side), spring);
  const std::size_t k = longest_side_of(face);
  const Edge longest{corner(face, k, side), corner(face, (k + 1) % 3, side)};
  return of_cylinder_beside_side(cylinder, longest, spring, nullptr);
}

}  // namespace

bool can_extend(const Simplex& a, const Simplex& b) {
  if (a.count == 1 || b.count == 1) return false;
  return (a.count == 3 && b.count == 3) || is_cylinder(a) || is_cylinder(b);
}

PairForces extended_part(const Simplex& a, const Simplex& b, const NormalSpring& spring) {
  if (a.count == 3 && b.count == 3)
    return is_needle(a) || is_needle(b) ? PairForces{} : facing_facets(a, b, spring);
  if (a.count == 3) return forces_of(of_cylinder_and_face(ends(b, Side::b), a, Side::a, spring));
  if (b.count == 3) return forces_of(of_cylinder_and_face(ends(a, Side::a), b, Side::b, spring));
  const Edge edge_a = ends(a, Side::a);
  const Edge edge_b = ends(b, Side::b);
  if (is_cylinder(a) && is_cylinder(b)) return forces_of(of_cylinders(edge_a, edge_b, spring));
  return forces_of(is_cylinder(a) ? of_cylinder_beside_side(edge_a, edge_b, spring, nullptr)
                                  : of_cylinder_beside_side(edge_b, edge_a, spring, nullptr));
}

}  // namespace plekton::contact::structure
