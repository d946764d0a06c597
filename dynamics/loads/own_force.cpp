// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/own_force.hpp"

#include "dynamics/model/require_index.hpp"
#include "dynamics/state/rigid_nodes.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace plekton::dynamics {

void require_own_force(const std::vector<NodeId>& nodes, const OwnForce& force,
                       const RigidNodes& rigid, std::size_t node_count) {
  if (!force) throw std::invalid_argument("add_force: got no function to ask for the forces");
  for (const NodeId node : nodes) {
    require_node("add_force", node, node_count);
    if (rigid.body_followed_by(node) >= 0)
      throw std::invalid_argument("add_force: node " + std::to_string(index_of(node)) +
                                  " follows a rigid body; load its reference node");
  }
  std::vector<NodeId> sorted = nodes;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end())
    throw std::invalid_argument("add_force: node " + std::to_string(index_of(*twice)) +
                                " is there twice; name each once");
}

LoadedNodes& OwnForcedNodes::act(const LoadStep& step, const NodeState& state,
                                 geometry::ThreadPool& pool) {
  forces_.assign(nodes_.size(), {Vec3::Zero(), Vec3::Zero()});
  force_(step.time, state, forces_);
  nodes_.set(pool, [&](std::size_t i) { return forces_[i]; });
  return nodes_;
}

}  // namespace plekton::dynamics
