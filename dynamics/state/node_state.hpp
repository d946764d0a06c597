// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"

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

/// Which motions of a node are prescribed, along and about the axes of the world: then its velocity
/// is what the loads say, and forces do not change it.
enum class Held : std::uint8_t {
  nothing = 0,
  along_x = 1,
  along_y = 2,
  along_z = 4,
  translation = 7,
  about_x = 8,
  about_y = 16,
  about_z = 32,
  rotation = 56,
  everything = 63,
  /// Not a motion: the node is the reference node of a rigid body, which steps its velocities with
  /// its own mass and inertia (dynamics/rigid/rigid_bodies.hpp). What else is held of it is held of
  /// the body.
  by_body = 64
};

constexpr Held operator|(Held a, Held b) noexcept {
  return static_cast<Held>(static_cast<std::uint8_t>(a) | static_cast<std::uint8_t>(b));
}
constexpr Held operator&(Held a, Held b) noexcept {
  return static_cast<Held>(static_cast<std::uint8_t>(a) & static_cast<std::uint8_t>(b));
}

/// Whether a node is the reference node of a rigid body.
constexpr bool is_reference(Held held) noexcept {
  return (static_cast<unsigned>(held) & 64U) != 0;
}
/// Whether all of the translation is held.
constexpr bool holds_translation(Held held) noexcept {
  return (held & Held::translation) == Held::translation;
}
/// Whether all of the rotation is held.
constexpr bool holds_rotation(Held held) noexcept {
  return (held & Held::rotation) == Held::rotation;
}
/// Whether the translation along an axis of the world is held.
constexpr bool holds_along(Held held, int axis) noexcept {
  return (static_cast<unsigned>(held) >> axis & 1U) != 0;
}
/// Whether the rotation about an axis of the world is held.
constexpr bool holds_about(Held held, int axis) noexcept {
  return (static_cast<unsigned>(held) >> (3 + axis) & 1U) != 0;
}

/// 1 along the axes in which a node is free to move, 0 along the others.
inline Vec3 free_axes(Held held) noexcept {
  return {holds_along(held, 0) ? 0.0 : 1.0, holds_along(held, 1) ? 0.0 : 1.0,
          holds_along(held, 2) ? 0.0 : 1.0};
}
/// 1 about the axes about which a node is free to turn, 0 about the others.
inline Vec3 free_turns(Held held) noexcept {
  return {holds_about(held, 0) ? 0.0 : 1.0, holds_about(held, 1) ? 0.0 : 1.0,
          holds_about(held, 2) ? 0.0 : 1.0};
}

/// What does not change about a node. Arrays of equal length, by NodeId.
struct NodeProperties {
  std::vector<double> mass;     ///< kg, > 0 where it may move, else >= 0
  std::vector<double> inertia;  ///< kg m², > 0 where it may turn, else >= 0; about every axis
  std::vector<Held> held;

  std::size_t size() const noexcept { return mass.size(); }
};

/// A state with which the nodes came to this one in a time (s), with the velocities of now.
NodeState state_before(const NodeState& state, double time);

/// m, where the nodes were so much time (s) ago, with the velocities of now.
inline std::vector<Vec3> positions_before(const NodeState& state, double time) {
  std::vector<Vec3> positions = state.position;
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] -= time * state.velocity[i];
  return positions;
}

}  // namespace plekton::dynamics
