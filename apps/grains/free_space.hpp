// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/bodies.hpp"
#include "geometry/base/types.hpp"
#include "geometry/primitives/box.hpp"

#include <array>
#include <span>
#include <vector>

namespace plekton::apps {

/// Part of a radius by which a box may be too narrow for a ball.
inline constexpr double kRounding = 1e-9;

using geometry::Box;
using geometry::Vec3;

/// A body that grains must not overlap when they are placed: all within a radius of a ball's centre
/// or a triangle.
struct Obstacle {
  std::array<Vec3, 3> core;  ///< m; three times the same point for a ball
  double radius;             ///< m
  double spring = 0.0;  ///< m, E R of its side of a contact over E of the grains, for a packing;
                        ///< 0: as that of the grain
};

/// Distance (m) from a point to a triangle, which may be collinear or a point.
double distance_to_triangle(const Vec3& point, const std::array<Vec3, 3>& triangle) noexcept;

/// Where in a box there is room for a ball: a grid of cells, each with the obstacles that a ball
/// with its centre there could meet. A query takes constant time if the obstacles are not much
/// smaller than the balls.
class FreeSpace {
 public:
  /// @param box      m. Balls must lie in it wholly.
  /// @param largest  m, > 0, radius of the largest ball that will be asked for.
  FreeSpace(const Box& box, double largest, std::span<const contact::Plane> planes);

  /// Everything that reaches into the box counts, the rest is ignored.
  void add(const Obstacle& obstacle);

  /// Whether a ball lies in the box and on the free side of every plane, and overlaps no obstacle.
  /// Touching is no overlap.
  bool has_room(const Vec3& centre, double radius) const;

 private:
  std::array<std::size_t, 3> cell_of(const Vec3& point) const;
  std::size_t index_of_cell(const std::array<std::size_t, 3>& cell) const;

  Box box_;
  double largest_;
  std::span<const contact::Plane> planes_;
  Vec3 cell_size_;
  std::array<std::size_t, 3> cell_counts_;
  std::vector<Obstacle> obstacles_;
  std::vector<std::vector<std::uint32_t>> cells_;  // positions in obstacles_
};

}  // namespace plekton::apps
