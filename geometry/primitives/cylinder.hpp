// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/box.hpp"

#include <array>
#include <numbers>

namespace plekton::geometry {

/// Capsule between two nodes: the Minkowski sum of a segment with a ball. Coincident nodes make it
/// a sphere.
struct Cylinder {
  std::array<NodeId, 2> nodes;
  double radius;  ///< m, >= 0; of what is in contact > 0
};

/// Corners of the core (m).
inline std::array<Vec3, 2> core(const Cylinder& cylinder, Positions x) noexcept {
  return {x[index_of(cylinder.nodes[0])], x[index_of(cylinder.nodes[1])]};
}

/// Box that holds the element and everything nearer to it than a margin (m).
inline Box box(const Cylinder& cylinder, Positions x, double margin = 0.0) noexcept {
  return bounding_box(core(cylinder, x), cylinder.radius + margin);
}

/// Volume (m³) of the tube between the nodes, without the caps, which neighbouring cylinders share.
inline double volume(const Cylinder& cylinder, Positions x) noexcept {
  const auto [x0, x1] = core(cylinder, x);
  return std::numbers::pi * cylinder.radius * cylinder.radius * (x1 - x0).norm();
}

}  // namespace plekton::geometry
