// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"
#include "geometry/base/orderless_sum.hpp"
#include "geometry/base/parallel_sum.hpp"

#include <algorithm>
#include <span>

namespace plekton::dynamics {

/// What moves the nodes besides the forces on them.
struct MotionOptions {
  Vec3 gravity = Vec3::Zero();  ///< m/s²
  double damping = 0.0;         ///< numerical damping lambda, in [0, 1); 0 is none
  bool damps_gravity = true;    ///< false: a free fall is not damped
};

/// How long a step is.
struct StepLengths {
  double kick;   ///< s, from the middle of the last drift to the middle of the next one
  double drift;  ///< s, from these positions to the next ones
};

/// What a step did to the energy.
struct StepWork {
  double kinetic = 0.0;   ///< J, at the moment of the forces
  double damped = 0.0;    ///< J, taken by numerical damping
  double external = 0.0;  ///< J, done on the rest by nodes whose motion is prescribed
  /// m²/s², squared speed of the fastest node after the step; infinite if some motion is not finite
  /// or a spin is beyond 1e150 rad/s.
  double fastest_squared = 0.0;
  double fastest_spin_squared = 0.0;  ///< rad²/s², of the node that spins fastest after the step

  StepWork& operator+=(const StepWork& other) noexcept {
    kinetic += other.kinetic;
    damped += other.damped;
    external += other.external;
    fastest_squared = std::max(fastest_squared, other.fastest_squared);
    fastest_spin_squared = std::max(fastest_spin_squared, other.fastest_spin_squared);
    return *this;
  }
};

/// The same of some nodes, to be put together in any order.
struct StepSums {
  geometry::OrderlessSum kinetic, damped, external;  ///< J
  double fastest_squared = 0.0;                      ///< m²/s²
  double fastest_spin_squared = 0.0;                 ///< rad²/s²

  StepSums& operator+=(const StepSums& other) noexcept {
    kinetic += other.kinetic;
    damped += other.damped;
    external += other.external;
    fastest_squared = std::max(fastest_squared, other.fastest_squared);
    fastest_spin_squared = std::max(fastest_spin_squared, other.fastest_spin_squared);
    return *this;
  }
  StepWork total() const noexcept {
    return {kinetic.value(), damped.value(), external.value(), fastest_squared,
            fastest_spin_squared};
  }
};

/// Leapfrog: v(t + dt/2) = v(t - dt/2) + a(t) dt, x(t + dt) = x(t) + v(t + dt/2) dt; rotations
/// likewise, each step an exact rotation. Second order and symplectic. The first kick is half a
/// drift long, since the velocities are given at the start itself, and a kick between drifts of
/// different lengths is their mean.
///
/// The kinetic energy at time t is 1/2 m v(t - dt/2).v(t + dt/2): with it the energy of a linear
/// oscillator is exactly constant. dt is that of the next drift, and v is taken as straight in time
/// where the last one was of another length; before the first one v(t - dt/2) is what would have
/// led to the velocity at the start, so that a load which is there at once leaves nothing. Held
/// motions stay as they are and are left out of the energy: what they do is external work.
///
/// Numerical damping scales each component of the acceleration by 1 - lambda sgn(a v), v at the
/// moment of the forces. It is not frame-indifferent and not for tests of momentum. Cundall; see
/// Potyondy & Cundall, Int. J. Rock Mech. Min. Sci. 41 (2004) 1329-1364, 2.
class Leapfrog {
 public:
  /// One step of all nodes.
  StepSums step(NodeState& state, const NodeForces& forces, const NodeProperties& properties,
                const MotionOptions& options, const StepLengths& lengths,
                geometry::ThreadPool& pool);
  /// One step of some nodes. @param nodes  ascending, each once
  StepSums step_some(std::span<const NodeId> nodes, NodeState& state, const NodeForces& forces,
                     const NodeProperties& properties, const MotionOptions& options,
                     const StepLengths& lengths, geometry::ThreadPool& pool);

 private:
  geometry::ParallelSum<StepSums> sum_;
};

}  // namespace plekton::dynamics
