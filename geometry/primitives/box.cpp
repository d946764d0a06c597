// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/primitives/box.hpp"

#include <cmath>
#include <limits>

namespace plekton::geometry {

Box bounding_box(std::span<const Vec3> points, double margin) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{points.front(), points.front()};
  for (const Vec3& point : points.subspan(1)) {
    box.lower = box.lower.cwiseMin(point);
    box.upper = box.upper.cwiseMax(point);
  }
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = std::nextafter(box.lower[axis] - margin, -kInfinity);
    box.upper[axis] = std::nextafter(box.upper[axis] + margin, kInfinity);
  }
  return box;
}

}  // namespace plekton::geometry
