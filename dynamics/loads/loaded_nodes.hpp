// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"
#include "geometry/base/parallel_sum.hpp"

#include <vector>

namespace plekton::dynamics {

/// The forces of one load on its nodes: kept from when they are worked out until the next velocity
/// is known, so that their work can be counted on both sides of the moment they act in.
///
/// A force F(t) acts in half of the drift before it and half of the one after it; its work is F.v
/// times half of either. Summed over steps that is the trapezoidal rule: exact for springs.
class LoadedNodes {
 public:
  /// @param nodes  each once
  explicit LoadedNodes(std::vector<NodeId> nodes)
      : nodes_(std::move(nodes)), forces_(nodes_.size()) {}

  std::size_t size() const noexcept { return nodes_.size(); }
  NodeId node(std::size_t i) const noexcept { return nodes_[i]; }

  struct Force {
    Vec3 force;                  ///< N
    Vec3 torque = Vec3::Zero();  ///< N m
  };

  /// Takes the force on each node, of(i) for node(i). No allocation.
  template <class Of>
  void set(geometry::ThreadPool& pool, Of&& of) {
    pool.for_each_range(size(), [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t i = begin; i < end; ++i) {
        const Force force = of(i);
        forces_.force[i] = force.force;
        forces_.torque[i] = force.torque;
      }
    });
  }

  void add_to(NodeForces& forces, geometry::ThreadPool& pool) const;
  /// W, of these forces at these velocities.
  double power(const NodeState& state, geometry::ThreadPool& pool);

 private:
  std::vector<NodeId> nodes_;
  NodeForces forces_;  // by place in nodes_
  geometry::ParallelSum<double> sum_;
};

}  // namespace plekton::dynamics
