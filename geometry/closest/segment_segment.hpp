// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/closest/closest_points.hpp"

#include <array>

namespace plekton::geometry {

/// Nearest points of two segments (closest_points.hpp).
/// @param a, b  m. Corners, anywhere; they may coincide or be collinear
ClosestPoints segment_segment(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) noexcept;

}  // namespace plekton::geometry
