// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace plekton::geometry {

/// Which points are one.
struct Weld {
  std::vector<std::size_t> representative;  ///< of every point: the lowest point it is joined with
  std::vector<Vec3> position;  ///< m, of every point: that of the lexicographically smallest one it
                               ///< is joined with
  std::size_t merged = 0;      ///< points that are not their own representative
  double largest_move = 0.0;   ///< m, from a point to the position of its group
};

/// Joins points that coincide exactly (0 and -0 are the same coordinate). n log n.
Weld weld_equal_points(std::span<const Vec3> points);

/// Joins points that are connected by steps of at most a distance (m, > 0). Both the groups and
/// their positions are independent of the order of the points. n log n while few points fall into
/// one ball of that radius.
/// @throws MeshError if the distance is below 1e-12 of the extent of the points, where it is no
///         better than rounding.
Weld weld_near_points(std::span<const Vec3> points, double distance);

}  // namespace plekton::geometry
