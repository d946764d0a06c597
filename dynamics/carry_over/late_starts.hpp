// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"

#include <vector>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::dynamics {

class RigidBodies;
class RigidNodes;

/// Motions that begin while others go on: of nodes that are new or are let go.
///
/// Their velocities are those of the moment of the next forces, those of all others are of the
/// middle of the last drift. A kick over half of that and half of the next drift would give them what
/// they had no time for: with a last drift that was chosen without them, far more energy than they
/// have. So they are put back by half of the last drift, and their first kick is half of the next.
class LateStarts {
 public:
  struct Lengths {
    double last_drift;  ///< s
    double drift;       ///< s, that begins now
  };
  /// All that decides how nodes are moved, with all forces on them.
  struct Moved {
    NodeState& state;
    const NodeForces& forces;
    const NodeProperties& properties;
    const RigidNodes& rigid;
    RigidBodies& bodies;
    const Vec3& gravity;  ///< m/s²
  };

  /// @param motions  that begin
  void add(NodeId node, Held motions) {
    if ((motions & Held::everything) != Held::nothing) starts_.push_back({node, motions});
  }
  bool empty() const noexcept { return starts_.empty(); }

  /// Puts them back, and forgets them: in the order in which they were added.
  /// @returns the kinetic energy (J) that they have at this moment beyond what the leapfrog takes it
  ///          for, as at any start (leapfrog.hpp): 1/8 m (a dt)², dt the next drift
  double put_back(const Lengths& lengths, const Moved& moved);

  /// Of a state that is of before they began; states of others have nothing of it.
  void exchange(const geometry::StateArchive& archive, std::size_t node_count);

 private:
  struct Start {
    NodeId node;
    Held motions;
  };

  std::vector<Start> starts_;
};

}  // namespace plekton::dynamics
