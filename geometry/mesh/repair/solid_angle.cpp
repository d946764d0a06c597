// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/solid_angle.hpp"

#include "geometry/base/elementary.hpp"

#include <cmath>

namespace plekton::geometry {

double solid_angle(const std::array<Vec3, 3>& x, const Vec3& point) noexcept {
  // tan(angle / 2) = a . (b x c) / (|a||b||c| + (a.b)|c| + (b.c)|a| + (c.a)|b|)
  const Vec3 a = x[0] - point, b = x[1] - point, c = x[2] - point;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2.0 * elementary::atan2(a.dot(b.cross(c)),
                                 la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace plekton::geometry
