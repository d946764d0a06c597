// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/integrators/leapfrog.hpp"
#include "dynamics/state/node_state.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact {
class SharedMotion;
struct NodesInMotion;
}  // namespace plekton::contact

namespace plekton::dynamics {

/// The nodes of a simulation that several ranks may compute together: moves those that this rank
/// has to move, and knows whether it knows all of them. On one process it moves all.
class NodesOfRanks {
 public:
  /// @param state, forces  must outlive this
  NodesOfRanks(NodeState& state, NodeForces& forces) noexcept : state_(state), forces_(forces) {}

  /// @param shared    null: one process
  /// @param acted_on  by NodeId, 1: something besides contacts and weight acts on it
  /// @param planes    by plane, 1: something looks in each step at what is near it
  void share(contact::SharedMotion* shared, std::vector<std::uint8_t> acted_on,
             std::vector<std::uint8_t> planes);

  /// Something more acts on these nodes from now on.
  void act_on(std::span<const NodeId> nodes);

  /// To be called by all ranks, before anything looks at nodes that no structure or load is near
  /// to. It costs nothing if they are known.
  void know_all() const {
    if (!knows_all_) tell_all();
  }
  /// The forces of a step have been found: each rank knows those on its own nodes.
  void found_forces() noexcept;

  /// Who knows which nodes; null: this process knows all.
  contact::SharedMotion* shared() const noexcept { return are_shared() ? shared_ : nullptr; }

  /// One step of all nodes. @returns what it did to the energy, the same on all ranks
  StepWork step(const NodeProperties& properties, const MotionOptions& options,
                const StepLengths& lengths, geometry::ThreadPool& pool);

 private:
  bool are_shared() const noexcept;
  void tell_all() const;
  contact::NodesInMotion nodes() const noexcept;

  NodeState& state_;
  NodeForces& forces_;
  contact::SharedMotion* shared_ = nullptr;
  mutable bool knows_all_ = true;
  Leapfrog leapfrog_;
};

}  // namespace plekton::dynamics
