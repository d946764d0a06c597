// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <array>

namespace plekton::geometry {

/// Solid angle (steradian, in [-2 pi, 2 pi]) under which a triangle is seen from a point; positive
/// if the point is on its lower side, from which it runs clockwise. The sum over a closed surface
/// that faces outward is 4 pi inside and 0 outside. A point in the plane of the triangle sees 0, or
/// +-2 pi if it is inside. Source: van Oosterom & Strackee, The solid angle of a plane triangle
/// (1983), eq. 8.
double solid_angle(const std::array<Vec3, 3>& x, const Vec3& point) noexcept;

}  // namespace plekton::geometry
