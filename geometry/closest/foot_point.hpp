// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <array>

/// Perpendicular foot points, computed from coordinate differences only: no accuracy is lost far
/// from the origin. Whether the foot lies inside the segment or triangle is for the exact signs to
/// say, not for these.
namespace plekton::geometry {

/// Foot of the perpendicular from a point.
struct FootPoint {
  Vec3 weights;     ///< of the corners, clamped to [0, 1], sum 1
  Vec3 direction;   ///< unit, from the point to the foot
  double distance;  ///< m
};

/// Foot on a point. At distance 0 the direction is the z axis.
FootPoint foot_on_node(const Vec3& point, const Vec3& x) noexcept;

/// Foot on the line through a segment, which has a length; weights of the two ends.
/// At distance 0 the direction is one perpendicular to the line that depends on the line alone.
FootPoint foot_on_edge(const Vec3& point, const std::array<Vec3, 2>& x) noexcept;

/// Foot on a triangle with an area, for a point whose foot is inside by the exact signs. At
/// distance 0 the direction is the triangle's normal.
///
/// The frame is built on the longest side e: e and the part v of another side that is perpendicular
/// to e. For a sliver the rounding error of v is large relative to its length and turns the plane
/// about e. The foot point is kept inside the triangle, so what turns is at most as long as v: the
/// distance keeps the accuracy of the coordinates for any shape, however thin, and the foot point
/// is off by at most the smaller of the height and error / height.
FootPoint foot_on_face(const Vec3& point, const std::array<Vec3, 3>& x) noexcept;

}  // namespace plekton::geometry
