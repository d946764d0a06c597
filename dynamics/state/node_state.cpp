// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/state/node_state.hpp"

#include "dynamics/state/rotation_step.hpp"

namespace plekton::dynamics {

NodeState state_before(const NodeState& state, double time) {
  NodeState before = state;
  before.position = positions_before(state, time);
  for (std::size_t i = 0; i < before.size(); ++i)
    before.orientation[i] = turned(state.orientation[i], state.angular_velocity[i], -time);
  return before;
}

}  // namespace plekton::dynamics
