// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrators/leapfrog.hpp"

#include "dynamics/integrators/leapfrog_lanes.hpp"
#include "geometry/rows.hpp"
#include "geometry/vector_width.hpp"

namespace plekton::dynamics {
namespace {

NodeArrays arrays(NodeState& state, const NodeForces& forces, const NodeProperties& properties) {
  return {state.position.data(),    state.velocity.data(),     state.angular_velocity.data(),
          state.orientation.data(), forces.force.data(),       forces.torque.data(),
          properties.mass.data(),   properties.inertia.data(), properties.held.data()};
}

template <class Rows>
StepWork total(const Rows& work, std::size_t count) noexcept {
  StepWork total;
  for (std::size_t i = 0; i < count; ++i) {
    StepWorkOf<double> of_node;
    work.get(i, of_node);
    total += {of_node.kinetic, of_node.damped, of_node.external};
  }
  return total;
}

}  // namespace

StepWork Leapfrog::step(NodeState& state, const NodeForces& forces,
                        const NodeProperties& properties, const MotionOptions& options,
                        const StepLengths& lengths, geometry::ThreadPool& pool) {
  const NodeArrays nodes = arrays(state, forces, properties);
  return sum_(state.size(), pool, [&](std::size_t begin, std::size_t end, int) {
    geometry::RowsOf<StepWorkOf<double>, geometry::ParallelSum<StepWork>::kChunk> work;
    geometry::with_widest_vectors([&](auto width) __attribute__((always_inline)) {
      const std::size_t last = end - (end - begin) % std::size_t{width};
      for (std::size_t i = begin; i < last; i += std::size_t{width})
        work.store(i - begin, step_lanes<width>(nodes.from(i), options, lengths));
      for (std::size_t i = last; i < end; ++i)
        work.store(i - begin, step_lanes<1>(nodes.from(i), options, lengths));
    });
    return total(work, end - begin);
  });
}

}  // namespace plekton::dynamics
