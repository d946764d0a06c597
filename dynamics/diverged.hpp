// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/node_state.hpp"

#include <span>
#include <stdexcept>

namespace plekton::dynamics {

/// The simulation has become meaningless: a node is no longer anywhere, or has moved further in one
/// step than the elements could notice. The message names step, time, node, position and what to
/// do.
class Diverged : public std::runtime_error {
 public:
  Diverged(std::int64_t step, double time, NodeId node, const Vec3& position, const Vec3& velocity);

  std::int64_t step() const noexcept { return step_; }
  NodeId node() const noexcept { return node_; }

 private:
  std::int64_t step_;
  NodeId node_;
};

/// @param furthest  m, by node: what it may move in a step of dt (s)
/// @throws Diverged naming the first node that moved further, or whose position is not finite
void check_finite(const NodeState& state, std::span<const double> furthest, double dt,
                  std::int64_t step, double time);

}  // namespace plekton::dynamics
