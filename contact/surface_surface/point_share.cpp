// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/point_share.hpp"

namespace plekton::contact::structure {
namespace {

/// The slopes of a function by the corners of a facet.
/// @param by_normal  those by its unit normal
std::array<Vec3, 3> by_corners(const Simplex& facet, const Vec3& by_normal) {
  const Vec3 area_normal = area_normal_of(facet);
  const double length = area_normal.norm();
  const Vec3 normal = area_normal / length;
  const Vec3 by_cross = (by_normal - by_normal.dot(normal) * normal) / length;
  const Vec3 by_first = (facet.x[2] - facet.x[0]).cross(by_cross);
  const Vec3 by_second = by_cross.cross(facet.x[1] - facet.x[0]);
  return {-(by_first + by_second), by_first, by_second};
}

}  // namespace

double tilt_between(const Simplex& a, const Simplex& b) {
  if (a.count != 3 || b.count != 3 || is_needle(a) || is_needle(b)) return -1.0;
  return normal_of(a).cross(normal_of(b)).squaredNorm();
}

PairForces tilting_forces(const Simplex& a, const Simplex& b, double by_tilt) {
  const Vec3 normal_a = normal_of(a);
  const Vec3 normal_b = normal_of(b);
  const Vec3 cross = normal_a.cross(normal_b);
  const auto by_a = by_corners(a, 2.0 * by_tilt * normal_b.cross(cross));
  const auto by_b = by_corners(b, 2.0 * by_tilt * cross.cross(normal_a));
  PairForces forces;
  for (std::size_t i = 0; i < 3; ++i) {
    forces.on_a[i] = -by_a[i];
    forces.on_b[i] = -by_b[i];
  }
  return forces;
}

}  // namespace plekton::contact::structure
