// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrators/leapfrog.hpp"

#include "dynamics/integrators/leapfrog_lanes.hpp"
#include "geometry/base/vector_width.hpp"

#include <algorithm>
#include <array>

namespace plekton::dynamics {
namespace {

NodeArrays arrays(NodeState& state, const NodeForces& forces, const NodeProperties& properties) {
  return {state.position.data(),    state.velocity.data(),     state.angular_velocity.data(),
          state.orientation.data(), forces.force.data(),       forces.torque.data(),
          properties.mass.data(),   properties.inertia.data(), properties.held.data()};
}

constexpr std::size_t kChunk = geometry::ParallelSum<StepSums>::kChunk;

/// What the nodes of a chunk did, node by node.
class ChunkWork {
 public:
  template <int W>
  PLEKTON_INLINE void set(std::size_t node, const StepWorkOf<Pack<W>>& work) noexcept {
    work.kinetic.store(&kinetic_[node]);
    work.damped.store(&damped_[node]);
    work.external.store(&external_[node]);
  }

  /// @param count  of nodes
  template <int W>
  PLEKTON_INLINE void add_to(StepSums& sums, std::size_t count) noexcept {
    const std::size_t whole = (count + W - 1) / W * W;
    for (auto* const numbers : {&kinetic_, &damped_, &external_})
      for (std::size_t i = count; i < whole; ++i) (*numbers)[i] = 0.0;
    sums.kinetic.add<W>(kinetic_.data(), whole);
    sums.damped.add<W>(damped_.data(), whole);
    sums.external.add<W>(external_.data(), whole);
  }

 private:
  std::array<double, kChunk> kinetic_, damped_, external_;  // J
};

/// The largest squares among nodes side by side.
template <int W>
struct Fastest {
  Pack<W> squared = 0.0, spin_squared = 0.0;

  PLEKTON_INLINE void look_at(const StepWorkOf<Pack<W>>& work) noexcept {
    squared = geometry::larger_of(work.fastest_squared, squared);
    spin_squared = geometry::larger_of(work.fastest_spin_squared, spin_squared);
  }
  PLEKTON_INLINE void add_to(StepSums& sums) const noexcept {
    for (std::size_t lane = 0; lane < std::size_t{W}; ++lane) {
      sums.fastest_squared = std::max<double>(sums.fastest_squared, squared.lanes[lane]);
      sums.fastest_spin_squared =
          std::max<double>(sums.fastest_spin_squared, spin_squared.lanes[lane]);
    }
  }
};

/// Nodes that lie anywhere, side by side in memory while they are stepped.
template <int W>
class Gathered {
 public:
  PLEKTON_INLINE Gathered(const NodeArrays& all, const NodeId* nodes) noexcept
      : all_(all), nodes_(nodes) {
    for (std::size_t i = 0; i < kCount; ++i) {
      const NodeArrays from = all.from(index_of(nodes[i]));
      position_[i] = *from.position;
      velocity_[i] = *from.velocity;
      angular_velocity_[i] = *from.angular_velocity;
      orientation_[i] = *from.orientation;
      force_[i] = *from.force;
      torque_[i] = *from.torque;
      mass_[i] = *from.mass;
      inertia_[i] = *from.inertia;
      held_[i] = *from.held;
    }
  }
  PLEKTON_INLINE NodeArrays arrays() noexcept {
    return {position_.data(),    velocity_.data(), angular_velocity_.data(),
            orientation_.data(), force_.data(),    torque_.data(),
            mass_.data(),        inertia_.data(),  held_.data()};
  }
  PLEKTON_INLINE void put_back() const noexcept {
    for (std::size_t i = 0; i < kCount; ++i) {
      const NodeArrays to = all_.from(index_of(nodes_[i]));
      *to.position = position_[i];
      *to.velocity = velocity_[i];
      *to.angular_velocity = angular_velocity_[i];
      *to.orientation = orientation_[i];
    }
  }

 private:
  static constexpr auto kCount = static_cast<std::size_t>(W);

  const NodeArrays& all_;
  const NodeId* nodes_;
  std::array<Vec3, kCount> position_, velocity_, angular_velocity_, force_, torque_;
  std::array<Quat, kCount> orientation_;
  std::array<double, kCount> mass_, inertia_;
  std::array<Held, kCount> held_;
};

/// Nodes one after the other.
struct Successive {
  std::size_t first;

  template <int W>
  PLEKTON_INLINE StepWorkOf<Pack<W>> step(std::size_t i, const NodeArrays& all,
                                          const MotionOptions& options,
                                          const StepLengths& lengths) const noexcept {
    return step_lanes<W>(all.from(first + i), options, lengths);
  }
};

/// Nodes that most often are one after the other.
struct Listed {
  const NodeId* nodes;

  template <int W>
  PLEKTON_INLINE StepWorkOf<Pack<W>> step(std::size_t i, const NodeArrays& all,
                                          const MotionOptions& options,
                                          const StepLengths& lengths) const noexcept {
    const NodeId* const some = nodes + i;
    if (index_of(some[W - 1]) - index_of(some[0]) == std::size_t{W} - 1)
      return step_lanes<W>(all.from(index_of(some[0])), options, lengths);
    Gathered<W> gathered(all, some);
    const auto work = step_lanes<W>(gathered.arrays(), options, lengths);
    gathered.put_back();
    return work;
  }
};

/// One step of a chunk of nodes.
template <class Nodes>
StepSums step_chunk(const Nodes& nodes, std::size_t count, const NodeArrays& all,
                    const MotionOptions& options, const StepLengths& lengths) {
  StepSums sums;
  ChunkWork chunk;
  geometry::with_widest_vectors([&](auto width) __attribute__((always_inline)) {
    constexpr int W = width;
    Fastest<W> fastest;
    Fastest<1> fastest_of_rest;
    const std::size_t last = count - count % std::size_t{W};
    for (std::size_t i = 0; i < last; i += std::size_t{W}) {
      const auto work = nodes.template step<W>(i, all, options, lengths);
      fastest.look_at(work);
      chunk.set<W>(i, work);
    }
    for (std::size_t i = last; i < count; ++i) {
      const auto work = nodes.template step<1>(i, all, options, lengths);
      fastest_of_rest.look_at(work);
      chunk.set<1>(i, work);
    }
    fastest.add_to(sums);
    fastest_of_rest.add_to(sums);
    chunk.add_to<W>(sums, count);
  });
  return sums;
}

}  // namespace

StepSums Leapfrog::step(NodeState& state, const NodeForces& forces,
                        const NodeProperties& properties, const MotionOptions& options,
                        const StepLengths& lengths, geometry::ThreadPool& pool) {
  const NodeArrays all = arrays(state, forces, properties);
  return sum_(state.size(), pool, [&](std::size_t begin, std::size_t end, int) {
    return step_chunk(Successive{begin}, end - begin, all, options, lengths);
  });
}

StepSums Leapfrog::step_some(std::span<const NodeId> nodes, NodeState& state,
                             const NodeForces& forces, const NodeProperties& properties,
                             const MotionOptions& options, const StepLengths& lengths,
                             geometry::ThreadPool& pool) {
  const NodeArrays all = arrays(state, forces, properties);
  return sum_(nodes.size(), pool, [&](std::size_t begin, std::size_t end, int) {
    return step_chunk(Listed{&nodes[begin]}, end - begin, all, options, lengths);
  });
}

}  // namespace plekton::dynamics
