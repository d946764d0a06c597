// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/sphere_surface/patch.hpp"
#include "dynamics/state/node_state.hpp"
#include "dynamics/stiffness/contact_springs.hpp"
#include "dynamics/time_step/stiffest_motion.hpp"

#include <vector>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::dynamics {

/// What contacts resist that spread over a surface, beside a spring for each of their terms.
///
/// A term whose weight is not that of one contact has a weight that changes with the distances of
/// others: its forces F_i(d_1, ..., d_n) have second derivatives between terms, and of the weights,
/// that no spring along a normal has. So for balls with such a term the rule itself is asked: let H
/// be the derivative of its normal forces and S that of the springs of the terms with their weights
/// as they are. The largest magnitude of an eigenvalue of M^(-1/2) (H - S) M^(-1/2), by power
/// iteration on central differences of the forces, times the mass is added to each node that takes
/// part (Weyl's inequality). It has all of the turning of bars and facets too, so that the springs
/// for it are left out.
class SpreadStiffness {
 public:
  /// @param rigid  rigid bodies among the nodes; must outlive this
  SpreadStiffness(const geometry::Surface& surface, const RigidNodes& rigid)
      : rigid_(&rigid), finder_(surface), motion_(rigid) {}

  /// Looks for balls that have a term which is not one contact.
  /// @returns whether there are any
  bool begin(ContactSprings& springs, std::size_t node_count);
  /// 1/s², of the last look: what has been added over the mass; 0 if there were none.
  double largest_rate() const noexcept { return motion_.largest_rate(); }
  /// The motion of the last look.
  void exchange(const geometry::StateArchive& archive);
  bool is_spread(NodeId ball) const noexcept {
    return is_spread_[index_of(rigid_->mover_of(ball))] != 0;
  }

  /// @param forces_of  (places, forces, finder): adds the normal forces (N) of the balls that are
  ///                   spread, as a function of the places alone
  template <class Forces>
  void add_to(NodalStiffness& stiffness, const ContactSprings& springs,
              const NodeProperties& properties, const StiffestMotion::Places& places,
              const Forces& forces_of) {
    for (int i = motion_.start(properties); i > 0; --i) {
      const bool moves =
          motion_.multiply(properties, places, [&](geometry::Positions moved, NodeForces& forces) {
            forces_of(moved, forces, finder_);
          });
      if (!moves) break;
      take_springs(springs, properties);
      motion_.follow(properties);
    }
    add_rate(properties, stiffness);
  }

 private:
  void take_springs(const ContactSprings& springs, const NodeProperties& properties);
  void add_rate(const NodeProperties& properties, NodalStiffness& stiffness) const;

  const RigidNodes* rigid_;
  contact::PatchFinder finder_;
  StiffestMotion motion_;
  std::vector<char> is_spread_;  ///< by node
};

}  // namespace plekton::dynamics
