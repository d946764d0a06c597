// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/exact_signs.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace plekton::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 point(const Vec3& p) {
  return {p[0], p[1], p[2]};
}

// Cyclic order of the axes keeps the orientation: along z the plane is (x, y), along x it is (y,
// z).
Kernel::Point_2 seen_along(Axis axis, const Vec3& p) {
  return {p[(axis.value + 1) % 3], p[(axis.value + 2) % 3]};
}

}  // namespace

bool are_collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  return CGAL::collinear(point(a), point(b), point(c));
}

int turn(Axis along, const Vec3& a, const Vec3& b, const Vec3& c) {
  return static_cast<int>(
      CGAL::orientation(seen_along(along, a), seen_along(along, b), seen_along(along, c)));
}

}  // namespace plekton::geometry
