// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/loads/load_step.hpp"
#include "dynamics/model/loads.hpp"
#include "geometry/base/parallel_sum.hpp"

namespace plekton::dynamics {

/// Nodes on their prescribed way: each drift gets the velocity that leads to the place of the table
/// at its end, so that nothing adds up over the steps.
class MovedNodes {
 public:
  /// @param at_start  where the motion is counted from
  MovedNodes(const PrescribedMotion& motion, const NodeState& at_start);

  /// Velocities right after time 0, for what looks at them before the first step.
  void start(NodeState& state) const;

  /// Sets the velocities of the drift that begins now.
  /// @param forces  all forces on the nodes
  /// @returns the work (J) done on the rest over half of the drift before, as far as the velocity
  ///          there was another one: the leapfrog counts the whole kick with the new velocity
  double act(const LoadStep& step, NodeState& state, const NodeForces& forces,
             geometry::ThreadPool& pool);

  /// m/s, at any of these times.
  double largest_speed(const TimeSpan& during) const noexcept;

 private:
  Vec3 displacement(double time) const noexcept;
  Mat3 rotation(double time) const;
  Vec3 place(std::size_t i, const Mat3& rotation, const Vec3& way) const noexcept;
  Vec3 spin(const LoadStep& step) const noexcept;

  PrescribedMotion motion_;
  std::vector<Vec3> start_;  // m, by place in motion_.nodes
  geometry::ParallelSum<double> sum_;
};

}  // namespace plekton::dynamics
