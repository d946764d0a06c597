// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"

#include <vector>

namespace plekton::dynamics {

/// Nodes that move as one body.
///
/// The reference node lies at the centre of mass, is turned as the principal axes are, and belongs
/// to no element: its place, rotation and velocities are those of the body, its mass and what is
/// held of it too. Loads and prescribed motions of the body act on it.
struct RigidBody {
  NodeId node{-1};                 ///< the reference node
  std::vector<NodeId> nodes = {};  ///< that follow it
  Vec3 moments = Vec3::Zero();     ///< kg m², principal moments of inertia, > 0 where it may turn
};

}  // namespace plekton::dynamics
