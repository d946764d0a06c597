// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/tracking/contact_record.hpp"
#include "dynamics/measures/diverged.hpp"
#include "dynamics/model/scene_figures.hpp"
#include "dynamics/time_step/step_limits.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace plekton::dynamics {

class StrongestAction;

/// How long the last drifts were.
struct Drifts {
  double last;     ///< s, between the forces of the last step and those before
  double drift;    ///< s, that the last step has moved the nodes by
  bool is_chosen;  ///< and that nobody gave
};

/// Finds who is at fault where a simulation has become meaningless.
class FaultFinder {
 public:
  /// All of it must outlive this.
  /// @param state     of the scene; moved back to where the forces were found while it is looked at
  /// @param forces    of the last step
  /// @param largest_radius  m, of all elements that there were at the start
  FaultFinder(const Resistance& of, const StepLimits& limits, NodeState& state,
              const NodeForces& forces, double largest_radius, geometry::ThreadPool& pool)
      : of_(of),
        limits_(&limits),
        state_(&state),
        forces_(&forces),
        furthest_(furthest_in_a_step(of.scene, largest_radius)),
        pool_(&pool) {}

  /// Who is at fault, and what to do about it.
  /// @param suspect  what acted where energy came from nowhere; may be empty
  std::string fault(const Divergence& divergence, const Drifts& drifts, const std::string& suspect);

  /// m, what a node may move in a step.
  double furthest(NodeId node) const noexcept { return furthest_[index_of(node)]; }

  /// What acted most on the node, and how; empty if nothing does.
  /// @param state  where the forces were found
  std::string strongest_action(const Divergence& divergence, const NodeState& state);

 private:
  double limit_exceeded_before(const Divergence& divergence, const Drifts& drifts) const noexcept;
  /// s, in which a node that moves or spins as it does now can be followed.
  double longest_followed(const Divergence& divergence) const noexcept;
  double critical_step_at(NodeState& state, double last, bool expected);
  void consider_contacts(NodeId node, geometry::Positions x, StrongestAction& action);
  bool has_node(const contact::ContactBody& body, NodeId node) const;
  bool moves(NodeId one, NodeId other) const noexcept;
  bool is_of_structure(const contact::ContactBody& body, NodeId node) const;
  void describe(const contact::ContactRecord& row, std::ostream& text) const;

  Resistance of_;
  const StepLimits* limits_;
  NodeState* state_;
  const NodeForces* forces_;
  std::vector<double> furthest_;  ///< m, by node
  geometry::ThreadPool* pool_;
};

}  // namespace plekton::dynamics
