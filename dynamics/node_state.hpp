// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/motion.hpp"

#include <cstdint>
#include <vector>

namespace plekton::dynamics {

using contact::NodeForces;
using geometry::index_of;
using geometry::Mat3;
using geometry::NodeId;
using geometry::Quat;
using geometry::Vec3;

/// Position, rotation and velocities of every node: the only state of a simulation. Arrays of equal
/// length, by NodeId.
struct NodeState {
  std::vector<Vec3> position;          ///< m
  std::vector<Vec3> velocity;          ///< m/s
  std::vector<Vec3> angular_velocity;  ///< rad/s
  std::vector<Quat> orientation;       ///< unit, from the node's frame to the world

  std::size_t size() const noexcept { return position.size(); }
  contact::Motion motion() const noexcept { return {position, velocity, angular_velocity}; }
};

/// Squares of speeds (m²/s²) and spins (rad²/s²) beyond this are no motion that could be computed.
constexpr double kLargestSquare = 1e300;

/// Which motions of a node are prescribed: then its velocity is what the loads say, and forces do
/// not change it.
enum class Held : std::uint8_t { nothing = 0, translation = 1, rotation = 2, everything = 3 };

constexpr bool holds_translation(Held held) noexcept {
  return (static_cast<std::uint8_t>(held) & 1U) != 0;
}
constexpr bool holds_rotation(Held held) noexcept {
  return (static_cast<std::uint8_t>(held) & 2U) != 0;
}

/// What does not change about a node. Arrays of equal length, by NodeId.
struct NodeProperties {
  std::vector<double> mass;     ///< kg, > 0
  std::vector<double> inertia;  ///< kg m², > 0, the same about every axis
  std::vector<Held> held;

  std::size_t size() const noexcept { return mass.size(); }
};

}  // namespace plekton::dynamics
