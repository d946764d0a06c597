// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/types.hpp"

#include <array>
#include <span>

namespace plekton::geometry {

/// Nearest points of two simplices.
struct NearestPoints {
  double distance;                  ///< m
  Vec3 normal;                      ///< unit, from a to b
  std::array<double, 3> weights_a;  ///< of the corners
  std::array<double, 3> weights_b;
  unsigned corners_a;  ///< bit k: corner k spans the lowest feature that holds the point
  unsigned corners_b;
};

/// Of two points, segments or triangles (1, 2 or 3 corners) that do not cross: the least over all
/// pairs of a corner and a feature whose foot point is inside by the exact signs, and of two edges
/// whose lines are nearest inside both. Of ties the first pair counts: corners of a before those of
/// b, these before edges. Formed from differences of coordinates.
///
/// Of cores that cross it is what the corners and edges have, not 0.
NearestPoints nearest_points(std::span<const Vec3> a, std::span<const Vec3> b) noexcept;

}  // namespace plekton::geometry
