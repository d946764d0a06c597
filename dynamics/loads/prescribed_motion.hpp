// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/loads/load_step.hpp"
#include "dynamics/model/loads.hpp"
#include "dynamics/state/rigid_body.hpp"
#include "geometry/base/parallel_sum.hpp"

namespace plekton::dynamics {

/// Nodes on their prescribed way: each drift gets the velocity that leads to the place of the table
/// at its end, so that nothing adds up over the steps.
class MovedNodes {
 public:
  /// @param at_start  where the motion is counted from
  /// @param lever     m, how far what turns with one of the nodes reaches from it (reach_around())
  MovedNodes(const PrescribedMotion& motion, const NodeState& at_start, double lever = 0.0);

  /// Velocities right after time 0, for what looks at them before the first step.
  void start(NodeState& state) const;

  /// Sets the velocities of the drift that begins now.
  /// @param forces  all forces on the nodes
  /// @returns the work (J) done on the rest over half of the drift before, as far as the velocity
  ///          there was another one: the leapfrog counts the whole kick with the new velocity
  double act(const LoadStep& step, NodeState& state, const NodeForces& forces,
             geometry::ThreadPool& pool);

  /// m/s, at any of these times, of the nodes and of what turns with them.
  double largest_speed(const TimeSpan& during) const noexcept;

 private:
  Vec3 displacement(double time) const noexcept;
  Mat3 rotation(double time) const;
  Vec3 place(std::size_t i, const Mat3& rotation, const Vec3& way) const noexcept;
  Vec3 spin(const LoadStep& step) const noexcept;

  PrescribedMotion motion_;
  double lever_;             // m
  std::vector<Vec3> start_;  // m, by place in motion_.nodes
  geometry::ParallelSum<double> sum_;
};

/// m, the largest distance of a node that follows a rigid body from its reference node, of those
/// that are among some nodes; 0 of others.
double reach_around(std::span<const NodeId> nodes, std::span<const RigidBody> bodies,
                    geometry::Positions x);

}  // namespace plekton::dynamics
