// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrators/leapfrog.hpp"

#include "dynamics/integrators/leapfrog_lanes.hpp"
#include "geometry/base/rows.hpp"
#include "geometry/base/vector_width.hpp"

namespace plekton::dynamics {
namespace {

NodeArrays arrays(NodeState& state, const NodeForces& forces, const NodeProperties& properties) {
  return {state.position.data(),    state.velocity.data(),     state.angular_velocity.data(),
          state.orientation.data(), forces.force.data(),       forces.torque.data(),
          properties.mass.data(),   properties.inertia.data(), properties.held.data()};
}

/// Lanes that sums are taken in: as many as the widest vectors have, so that the sums do not depend
/// on which vectors there are.
constexpr std::size_t kLanes = 8;
using LaneSums = geometry::RowsOf<StepWorkOf<double>, kLanes>;

/// Adds what W nodes did to the sums of lanes.
template <int W>
PLEKTON_INLINE void add(const StepWorkOf<Pack<W>>& work, std::size_t lane,
                        LaneSums& sums) noexcept {
  auto sum = sums.load<StepWorkOf<Pack<W>>>(lane);
  sum = {sum.kinetic + work.kinetic, sum.damped + work.damped, sum.external + work.external,
         geometry::larger_of(work.fastest_squared, sum.fastest_squared),
         geometry::larger_of(work.fastest_spin_squared, sum.fastest_spin_squared)};
  sums.store(lane, sum);
}

StepWork total(const LaneSums& sums) noexcept {
  StepWork total;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const auto of_lane = sums.at<StepWorkOf<double>>(lane);
    total += {of_lane.kinetic, of_lane.damped, of_lane.external, of_lane.fastest_squared,
              of_lane.fastest_spin_squared};
  }
  return total;
}

}  // namespace

StepWork Leapfrog::step(NodeState& state, const NodeForces& forces,
                        const NodeProperties& properties, const MotionOptions& options,
                        const StepLengths& lengths, geometry::ThreadPool& pool) {
  const NodeArrays nodes = arrays(state, forces, properties);
  return sum_(state.size(), pool, [&](std::size_t begin, std::size_t end, int) {
    LaneSums sums;
    for (std::size_t lane = 0; lane < kLanes; ++lane) sums.set(lane, StepWorkOf<double>{});
    geometry::with_widest_vectors([&](auto width) __attribute__((always_inline)) {
      const std::size_t last = end - (end - begin) % std::size_t{width};
      for (std::size_t i = begin; i < last; i += std::size_t{width})
        add<width>(step_lanes<width>(nodes.from(i), options, lengths), (i - begin) % kLanes, sums);
      for (std::size_t i = last; i < end; ++i)
        add<1>(step_lanes<1>(nodes.from(i), options, lengths), (i - begin) % kLanes, sums);
    });
    return total(sums);
  });
}

}  // namespace plekton::dynamics
