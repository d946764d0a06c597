// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/sphere_surface/patch.hpp"
#include "dynamics/state/node_state.hpp"
#include "dynamics/stiffness/contact_springs.hpp"

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
///
/// A rigid body takes part with its translation alone.
///
/// The iteration goes on with its last motion at the next look: few products are enough. It begins
/// with more.
class SpreadStiffness {
 public:
  /// @param rigid  rigid bodies among the nodes; must outlive this
  SpreadStiffness(const geometry::Surface& surface, const RigidNodes& rigid)
      : rigid_(&rigid), finder_(surface) {}

  /// Looks for balls that have a term which is not one contact.
  /// @returns whether there are any
  bool begin(ContactSprings& springs, std::size_t node_count);
  /// The motion of the last look.
  void exchange(const geometry::StateArchive& archive);
  bool is_spread(NodeId ball) const noexcept {
    return is_spread_[index_of(rigid_->mover_of(ball))] != 0;
  }

  /// Where nodes are (m), and how far a difference goes (m).
  struct Places {
    geometry::Positions x;
    double difference;
  };

  /// @param forces_of  (places, forces, finder): adds the normal forces (N) of the balls that are
  ///                   spread, as a function of the places alone
  template <class Forces>
  void add_to(NodalStiffness& stiffness, const ContactSprings& springs,
              const NodeProperties& properties, const Places& places, const Forces& forces_of) {
    double rate = 0.0;  // 1/s²
    for (int i = start(properties); i > 0; --i) {
      const double step = displace(properties, places, 1.0);
      if (step == 0.0) break;
      forces_.set_zero();
      forces_of(moved_, forces_, finder_);
      take_forces(-0.5 / step);
      displace(properties, places, -1.0);
      forces_.set_zero();
      forces_of(moved_, forces_, finder_);
      take_forces(0.5 / step);
      take_springs(springs, properties);
      rate = follow(properties);
    }
    add_rate(rate, properties, stiffness);
  }

 private:
  int start(const NodeProperties& properties);
  double displace(const NodeProperties& properties, const Places& places, double sign);
  void take_forces(double factor);
  void take_springs(const ContactSprings& springs, const NodeProperties& properties);
  double follow(const NodeProperties& properties);
  void add_rate(double rate, const NodeProperties& properties, NodalStiffness& stiffness) const;

  const RigidNodes* rigid_;
  contact::PatchFinder finder_;
  NodeForces forces_{0};
  std::vector<char> is_spread_;   ///< by node
  std::vector<char> takes_part_;  ///< by node
  std::vector<Vec3> motion_;      ///< by node, per root of mass; of length 1
  std::vector<Vec3> product_;     ///< N/m of a motion
  std::vector<Vec3> moved_;       ///< m
  bool is_new_ = true;            ///< the motion is that of no look before
};

}  // namespace plekton::dynamics
