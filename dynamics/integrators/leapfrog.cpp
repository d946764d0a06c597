// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrators/leapfrog.hpp"

#include "dynamics/integrators/leapfrog_block.hpp"
#include "geometry/vector_width.hpp"

#include <algorithm>

namespace plekton::dynamics {
namespace {

void gather(const NodeState& state, const NodeForces& forces, const NodeProperties& properties,
            std::size_t first, std::size_t count, LeapfrogBlock& block) {
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = first + k;
    block.translation.velocity.set(k, state.velocity[i]);
    block.translation.force.set(k, forces.force[i]);
    block.translation.inertia.set(k, properties.mass[i]);
    block.translation.is_held.set(k, holds_translation(properties.held[i]) ? 1.0 : 0.0);
    block.rotation.velocity.set(k, state.angular_velocity[i]);
    block.rotation.force.set(k, forces.torque[i]);
    block.rotation.inertia.set(k, properties.inertia[i]);
    block.rotation.is_held.set(k, holds_rotation(properties.held[i]) ? 1.0 : 0.0);
    block.orientation.set(k, state.orientation[i]);
  }
}

StepWork scatter(const LeapfrogBlock& block, std::size_t first, std::size_t count, double dt,
                 NodeState& state) {
  StepWork work;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = first + k;
    StepWorkOf<double> of_node;
    block.work.get(k, of_node);
    work += {of_node.kinetic, of_node.damped, of_node.external};
    block.translation.velocity.get(k, state.velocity[i]);
    block.rotation.velocity.get(k, state.angular_velocity[i]);
    double half_turn_squared;
    block.half_turn_squared.get(k, half_turn_squared);
    if (half_turn_squared < geometry::kSmallAngleSquared) {
      block.orientation.get(k, state.orientation[i]);
    } else {
      state.orientation[i] = turned(state.orientation[i], state.angular_velocity[i], dt);
    }
  }
  // In a loop of its own: a vector that was just written as three numbers cannot be read as one
  // without a stall.
  for (std::size_t i = first; i < first + count; ++i) state.position[i] += dt * state.velocity[i];
  return work;
}

}  // namespace

StepWork Leapfrog::step(NodeState& state, const NodeForces& forces,
                        const NodeProperties& properties, const MotionOptions& options,
                        const StepLengths& lengths, geometry::ThreadPool& pool) {
  return sum_(state.size(), pool, [&](std::size_t begin, std::size_t end, int) {
    StepWork work;
    for (std::size_t first = begin; first < end; first += LeapfrogBlock::kLanes) {
      const std::size_t count = std::min(LeapfrogBlock::kLanes, end - first);
      LeapfrogBlock block;
      gather(state, forces, properties, first, count, block);
      geometry::with_widest_vectors([&](auto width) __attribute__((always_inline)) {
        block.step<width>(count, options, lengths);
      });
      work += scatter(block, first, count, lengths.drift, state);
    }
    return work;
  });
}

}  // namespace plekton::dynamics
