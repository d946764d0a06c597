// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/box.hpp"

#include <array>

namespace plekton::geometry {

/// Thick triangle between three nodes: the Minkowski sum of a triangle with a ball, thickness 2
/// radius. Collinear nodes are allowed.
struct Facet {
  std::array<NodeId, 3> nodes;
  double radius;  ///< m, >= 0; of what is in contact > 0
};

/// Corners of the core (m).
inline std::array<Vec3, 3> core(const Facet& facet, Positions x) noexcept {
  return {x[index_of(facet.nodes[0])], x[index_of(facet.nodes[1])], x[index_of(facet.nodes[2])]};
}

/// Box that holds the element and everything nearer to it than a margin (m).
inline Box box(const Facet& facet, Positions x, double margin = 0.0) noexcept {
  return bounding_box(core(facet, x), facet.radius + margin);
}

/// Volume (m³) of the plate between the nodes, without its rounded rim, which neighbouring facets
/// share.
inline double volume(const Facet& facet, Positions x) noexcept {
  const auto [x0, x1, x2] = core(facet, x);
  return facet.radius * (x1 - x0).cross(x2 - x0).norm();
}

}  // namespace plekton::geometry
