// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/closest/closest_points.hpp"

#include <array>

namespace plekton::geometry {

/// Nearest points of two triangles (closest_points.hpp).
/// @param a, b  m. Corners, anywhere; they may coincide or be collinear
ClosestPoints triangle_triangle(const std::array<Vec3, 3>& a,
                                const std::array<Vec3, 3>& b) noexcept;

}  // namespace plekton::geometry
