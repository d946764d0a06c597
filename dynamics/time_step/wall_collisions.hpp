// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"
#include "dynamics/state/rigid_nodes.hpp"
#include "dynamics/stiffness/contact_springs.hpp"

#include <vector>

namespace plekton::dynamics {

/// A step that follows what falls on walls: nodes of nets and sheets, and rigid bodies that meet a
/// wall with many balls at once.
class WallCollisions {
 public:
  /// @param rigid  rigid bodies among the nodes; must outlive this
  explicit WallCollisions(const RigidNodes& rigid) : rigid_(&rigid) {}

  /// The step (s) at which what leapfrog loses and gains as contacts with walls begin and end is at
  /// most 1/16 of their energy; infinite if none is about to.
  ///
  /// A contact that begins or ends within a step is off by (omega dt)² / 4 of the energy of its
  /// motion at most (ContactSprings::collision_step()). Let f be the sum of k v over the springs k
  /// on a node or rigid body of mass M, v the speed at which each gets deeper, and P that of k v².
  /// Then omega² = f M^-1 f / P: k / m of a ball on one wall, n k / m of a plate that falls flat on
  /// n balls. The energy is that of the motion, P / (2 omega²), and what is stored. What is held
  /// deeper than its motion reaches neither begins nor ends, and does not count; of the others what
  /// the first part has more than the second is about to.
  double step(const ContactSprings& springs, const NodeState& state,
              const NodeProperties& properties);

 private:
  /// What walls do to a node or rigid body.
  struct Fall {
    Vec3 push = Vec3::Zero();  ///< N/s
    Vec3 turn = Vec3::Zero();  ///< N m/s, of a rigid body
    double power = 0.0;        ///< J/s²
    double stored = 0.0;       ///< J
  };

  void collect(const ContactSprings& springs, const NodeState& state);
  double answer(NodeId node, const NodeProperties& properties) const;

  const RigidNodes* rigid_;
  std::vector<Fall> falls_;  ///< by node
};

}  // namespace plekton::dynamics
