// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrators/leapfrog.hpp"

#include "dynamics/rotation_step.hpp"

namespace plekton::dynamics {
namespace {

/// Steps one velocity. @returns the work, for a mass of 1
StepWork kick(Vec3& velocity, const Vec3& damped_acceleration, const Vec3& free_acceleration, double damping,
              double dt) noexcept {
  const Vec3 before = velocity;
  const Vec3 undamped = damped_acceleration + free_acceleration;
  Vec3 removed = Vec3::Zero();
  if (damping > 0.0) {
    const Vec3 now = before + 0.5 * dt * undamped;
    for (int axis = 0; axis < 3; ++axis) {
      const double power = damped_acceleration[axis] * now[axis];
      const double sign = power > 0.0 ? 1.0 : power < 0.0 ? -1.0 : 0.0;
      removed[axis] = damping * sign * damped_acceleration[axis];
    }
  }
  velocity = before + dt * (undamped - removed);
  return {0.5 * before.dot(velocity), 0.5 * dt * removed.dot(before + velocity), 0.0};
}

StepWork scaled(double factor, const StepWork& work) noexcept {
  return {factor * work.kinetic, factor * work.damped, factor * work.external};
}

}  // namespace

StepWork Leapfrog::step(NodeState& state, const NodeForces& forces, const NodeProperties& properties,
                        const MotionOptions& options, double dt, geometry::ThreadPool& pool) {
  const Vec3 damped_gravity = options.damps_gravity ? options.gravity : Vec3(Vec3::Zero());
  const Vec3 free_gravity = options.gravity - damped_gravity;
  return sum_(state.size(), pool, [&](std::size_t begin, std::size_t end, int) {
    StepWork work;
    for (std::size_t i = begin; i < end; ++i) {
      if (holds_translation(properties.held[i])) {
        work.external -= dt * forces.force[i].dot(state.velocity[i]);
      } else {
        const Vec3 acceleration = forces.force[i] / properties.mass[i] + damped_gravity;
        work += scaled(properties.mass[i], kick(state.velocity[i], acceleration, free_gravity, options.damping, dt));
      }
      if (holds_rotation(properties.held[i])) {
        work.external -= dt * forces.torque[i].dot(state.angular_velocity[i]);
      } else {
        const Vec3 acceleration = forces.torque[i] / properties.inertia[i];
        work += scaled(properties.inertia[i],
                       kick(state.angular_velocity[i], acceleration, Vec3::Zero(), options.damping, dt));
      }
      state.position[i] += dt * state.velocity[i];
      if (!state.angular_velocity[i].isZero(0.0)) {
        state.orientation[i] = turned(state.orientation[i], state.angular_velocity[i], dt);
      }
    }
    return work;
  });
}

}  // namespace plekton::dynamics
