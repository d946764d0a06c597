// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/loads/load_step.hpp"
#include "dynamics/loads/loaded_nodes.hpp"

#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace plekton::dynamics {

class RigidNodes;

/// A force of one's own: sets the forces on some nodes, which are zero before, by place in the list
/// of these. Called once a step, from one thread. Its bits follow from the time (s) and the state
/// alone if runs are to be repeated, and on ranks it is called by all of them. What it throws comes
/// out of Simulation::step(), after which the simulation is to be thrown away.
using OwnForce =
    std::function<void(double time, const NodeState& state, std::span<LoadedNodes::Force> forces)>;

/// @throws std::invalid_argument for no function, and for nodes that are there twice or follow a
///         rigid body; std::out_of_range for none
void require_own_force(const std::vector<NodeId>& nodes, const OwnForce& force,
                       const RigidNodes& rigid, std::size_t node_count);

/// Nodes under a force of one's own.
class OwnForcedNodes {
 public:
  OwnForcedNodes(std::vector<NodeId> nodes, OwnForce force)
      : force_(std::move(force)), forces_(nodes.size()), nodes_(std::move(nodes)) {}

  LoadedNodes& act(const LoadStep& step, const NodeState& state, geometry::ThreadPool& pool);
  LoadedNodes& nodes() noexcept { return nodes_; }

 private:
  OwnForce force_;
  std::vector<LoadedNodes::Force> forces_;  // by place in nodes_
  LoadedNodes nodes_;
};

}  // namespace plekton::dynamics
