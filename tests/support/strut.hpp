// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/box.hpp"
#include "geometry/closest/primitive_pairs.hpp"

#include <array>

namespace plekton::test {

/// A primitive that only tests know, written as a new one would be: nothing but this file and its
/// rows in the table of pairs. The middle half of a cylinder between two nodes, whose ends it does
/// not reach.
struct Strut {
  std::array<geometry::NodeId, 2> nodes;
  double radius;  ///< m, > 0
};

/// Corners of the core (m).
inline std::array<geometry::Vec3, 2> core(const Strut& strut, geometry::Positions x) noexcept {
  const geometry::Vec3& x0 = x[index_of(strut.nodes[0])];
  const geometry::Vec3& x1 = x[index_of(strut.nodes[1])];
  return {0.75 * x0 + 0.25 * x1, 0.25 * x0 + 0.75 * x1};
}

/// Box that holds the element and everything nearer to it than a margin (m).
inline geometry::Box box(const Strut& strut, geometry::Positions x, double margin = 0.0) noexcept {
  return geometry::bounding_box(core(strut, x), strut.radius + margin);
}

/// The row of the strut: with any cell of a surface, and with any primitive.
inline geometry::Proximity proximity(const Strut& a, const geometry::Surface& surface,
                                     geometry::CellId cell, geometry::Positions x) noexcept {
  return proximity(geometry::probe_of(a, x), geometry::PlacedSurface{surface, x}, cell);
}
template <geometry::Primitive Other>
geometry::Proximity proximity(const Strut& a, const Other& b, geometry::Positions x) noexcept {
  return proximity(geometry::probe_of(a, x), geometry::probe_of(b, x));
}

}  // namespace plekton::test
