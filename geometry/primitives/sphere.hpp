// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/box.hpp"

#include <array>
#include <cstddef>
#include <numbers>
#include <span>

namespace plekton::geometry {

/// Ball around one node: the Minkowski sum of a point with a ball.
struct Sphere {
  std::array<NodeId, 1> nodes;
  double radius;  ///< m, >= 0; of what is in contact > 0
};

/// Corners of the core (m).
inline std::array<Vec3, 1> core(const Sphere& sphere, Positions x) noexcept {
  return {x[index_of(sphere.nodes[0])]};
}

/// Box that holds the element and everything nearer to it than a margin (m).
inline Box box(const Sphere& sphere, Positions x, double margin = 0.0) noexcept {
  return bounding_box(core(sphere, x), sphere.radius + margin);
}

/// The boxes of many spheres, each found where it is asked for.
class SphereBoxes {
 public:
  /// @param margin  m, as box() has it
  SphereBoxes(std::span<const Sphere> spheres, Positions x, double margin) noexcept
      : spheres_(spheres), x_(x), margin_(margin) {}

  std::size_t size() const noexcept { return spheres_.size(); }
  Box operator[](std::size_t i) const noexcept { return box(spheres_[i], x_, margin_); }
  /// m, without the work of a box, whose sides are rounded outwards.
  const Vec3& centre(std::size_t i) const noexcept { return x_[index_of(spheres_[i].nodes[0])]; }

 private:
  std::span<const Sphere> spheres_;
  Positions x_;
  double margin_;
};

/// Volume (m³).
inline double volume(const Sphere& sphere) noexcept {
  return 4.0 / 3.0 * std::numbers::pi * sphere.radius * sphere.radius * sphere.radius;
}

}  // namespace plekton::geometry
