// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/loads/load_step.hpp"
#include "dynamics/loads/loaded_nodes.hpp"
#include "dynamics/model/loads.hpp"

namespace plekton::dynamics {

/// Springs to the places where nodes are at the start: F = -k (x - x0) along each axis. What they
/// store is counted as external work, exactly.
class SprungNodes {
 public:
  SprungNodes(const GroundSprings& springs, const NodeState& at_start)
      : stiffness_(springs.stiffness), nodes_(springs.nodes), start_(springs.start) {
    if (!start_.empty()) return;
    for (const NodeId node : springs.nodes) start_.push_back(at_start.position[index_of(node)]);
  }

  LoadedNodes& act(const LoadStep&, const NodeState& state, geometry::ThreadPool& pool) {
    nodes_.set(pool, [&](std::size_t i) {
      const Vec3 way = state.position[index_of(nodes_.node(i))] - start_[i];
      return LoadedNodes::Force{-stiffness_.cwiseProduct(way)};
    });
    return nodes_;
  }
  LoadedNodes& nodes() noexcept { return nodes_; }
  const LoadedNodes& nodes() const noexcept { return nodes_; }
  /// N/m, along the axes of the world, of each node.
  const Vec3& stiffness() const noexcept { return stiffness_; }

 private:
  Vec3 stiffness_;
  LoadedNodes nodes_;
  std::vector<Vec3> start_;  // m, by place in nodes_
};

}  // namespace plekton::dynamics
