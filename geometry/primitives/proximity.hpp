// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/feature.hpp"

#include <array>

/// Signs, frames and units, for the whole library:
///   - lengths in m, positions in the world frame;
///   - the sides of a pair are a and b; the normal is the unit vector from a to b;
///   - gap = distance of the cores - radius_a - radius_b, negative when the bodies overlap;
///   - forces are given on side b; side a gets the opposite;
///   - the contact point lies on the line through both core points, half the gap away from either
///     surface: arm_a = radius_a + gap / 2 from the core point of a,
///              arm_b = radius_b + gap / 2 from that of b.
namespace plekton::geometry {

/// A point of the core of an element: the weighted mean of up to three nodes.
struct CorePoint {
  std::array<NodeId, 3> nodes;  ///< a node that is not needed repeats the first one, with weight 0
  Vec3 weights;                 ///< each >= 0, sum 1
  Feature feature;              ///< the lowest-dimensional feature that holds the point
};

/// World position (m) of a core point.
inline Vec3 position(const CorePoint& point, Positions x) noexcept {
  return point.weights[0] * x[index_of(point.nodes[0])] +
         point.weights[1] * x[index_of(point.nodes[1])] +
         point.weights[2] * x[index_of(point.nodes[2])];
}

/// The core point that a node is.
inline CorePoint core_point(NodeId node) noexcept {
  return {{node, node, node}, Vec3(1.0, 0.0, 0.0), Feature(node)};
}

enum class Relation : std::uint8_t {
  apart,
  touching_or_crossing  ///< the cores have a point in common
};

/// Two elements, where they are nearest to each other.
///
/// Cores that meet have relation touching_or_crossing; then the core points are one that they have
/// in common, the normal is the shortest way for b out of a, and the gap is -(length of that way +
/// radius_a + radius_b).
struct Proximity {
  CorePoint a;
  CorePoint b;
  Vec3 normal;   ///< unit, from a to b
  double gap;    ///< m, negative when overlapping
  double arm_a;  ///< m, from the core point of a to the contact point, along the normal
  double arm_b;  ///< m, from the core point of b to the contact point, against the normal
  Relation relation = Relation::apart;  ///< of the cores; decided exactly
};

}  // namespace plekton::geometry
