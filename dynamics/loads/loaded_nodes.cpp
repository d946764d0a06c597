// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/loaded_nodes.hpp"

namespace plekton::dynamics {

void LoadedNodes::add_to(NodeForces& forces, geometry::ThreadPool& pool) const {
  pool.for_each_range(size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      forces.force[index_of(nodes_[i])] += forces_.force[i];
      forces.torque[index_of(nodes_[i])] += forces_.torque[i];
    }
  });
}

double LoadedNodes::power(const NodeState& state, geometry::ThreadPool& pool) {
  return sum_(size(), pool, [&](std::size_t begin, std::size_t end, int) {
    double power = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t node = index_of(nodes_[i]);
      power += forces_.force[i].dot(state.velocity[node]) +
               forces_.torque[i].dot(state.angular_velocity[node]);
    }
    return power;
  });
}

}  // namespace plekton::dynamics
