// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/closest/closest_points.hpp"

#include <array>

namespace plekton::geometry {

/// Nearest points of a point and a segment (closest_points.hpp); a is the point.
/// @param p  m. Anywhere, also on b
/// @param b  m. Corners; they may coincide or be collinear
ClosestPoints point_segment(const Vec3& p, const std::array<Vec3, 2>& b) noexcept;

}  // namespace plekton::geometry
