// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/rim_share.hpp"

#include <array>
#include <cstddef>

namespace plekton::contact::structure {
namespace {

/// A node or an edge.
struct Rim {
  std::array<Vector, 2> x;
  std::size_t count = 0;
};

Rim rim_of(const std::array<Vector, 3>& facet, unsigned corners) {
  Rim rim;
  for (std::size_t k = 0; k < 3; ++k)
    if ((corners >> k & 1U) != 0) rim.x[rim.count++] = facet[k];
  return rim;
}

/// From a point to the line of an edge.
Vector to_line(const Vector& point, const Rim& edge) {
  const Vector along = edge.x[1] - edge.x[0];
  const Vector start = edge.x[0] - point;
  return start - (start.dot(along) / along.squaredNorm()) * along;
}

/// From the nearest point of one to that of the other, or against it.
Vector between(const Rim& a, const Rim& b) {
  if (a.count == 1 && b.count == 1) return b.x[0] - a.x[0];
  if (a.count == 1) return to_line(a.x[0], b);
  if (b.count == 1) return to_line(b.x[0], a);
  // Of edges that are parallel but for rounding the distance has no crossing to be read from.
  constexpr double kParallel = 1e-24;
  const Vector along_a = a.x[1] - a.x[0];
  const Vector along_b = b.x[1] - b.x[0];
  const Vector cross = along_a.cross(along_b);
  const double least = kParallel * still(along_a.squaredNorm()) * still(along_b.squaredNorm());
  return still(cross.squaredNorm()) > least ? cross : to_line(a.x[0], b);
}

/// Square of the sine of the angle between a direction and a normal of any length.
Real off_normal(const Vector& direction, const std::array<Vector, 3>& facet) {
  const Vector normal = (facet[1] - facet[0]).cross(facet[2] - facet[0]);
  const Real along = direction.dot(normal);
  return Real(1.0) - along * along / (direction.squaredNorm() * normal.squaredNorm());
}

}  // namespace

Real rim_share(const Simplex& a, unsigned corners_a, const Simplex& b, unsigned corners_b) {
  const std::array<Vector, 3> facet_a = corners(a, Side::a);
  const std::array<Vector, 3> facet_b = corners(b, Side::b);
  const Vector direction = between(rim_of(facet_a, corners_a), rim_of(facet_b, corners_b));
  if (!(still(direction.squaredNorm()) > 0.0)) return Real(0.0);
  return off_normal(direction, facet_a) * off_normal(direction, facet_b);
}

}  // namespace plekton::contact::structure
