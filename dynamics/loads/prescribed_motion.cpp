// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/prescribed_motion.hpp"

namespace plekton::dynamics {

MovedNodes::MovedNodes(const PrescribedMotion& motion, const NodeState& at_start)
    : motion_(motion) {
  for (const NodeId node : motion_.nodes) start_.push_back(at_start.position[index_of(node)]);
}

/// m, from the place at the start.
Vec3 MovedNodes::displacement(double time) const noexcept {
  const double way = motion_.factor.at(time) - motion_.factor.at(0.0);
  return way * motion_.displacement + motion_.factor.integral(time) * motion_.velocity;
}

/// rad/s, over the drift that begins now.
Vec3 MovedNodes::turn(const LoadStep& step) const noexcept {
  const double share =
      motion_.factor.integral(step.time + step.after) - motion_.factor.integral(step.time);
  return share / step.after * motion_.angular_velocity;
}

void MovedNodes::start(NodeState& state) const {
  const Vec3 velocity =
      motion_.factor.slope(0.0) * motion_.displacement + motion_.factor.at(0.0) * motion_.velocity;
  const Vec3 spin = motion_.factor.at(0.0) * motion_.angular_velocity;
  for (const NodeId node : motion_.nodes) {
    for (int axis = 0; axis < 3; ++axis) {
      if (holds_along(motion_.held, axis)) state.velocity[index_of(node)][axis] = velocity[axis];
      if (holds_about(motion_.held, axis))
        state.angular_velocity[index_of(node)][axis] = spin[axis];
    }
  }
}

double MovedNodes::act(const LoadStep& step, NodeState& state, const NodeForces& forces,
                       geometry::ThreadPool& pool) {
  const Vec3 way = displacement(step.time + step.after);
  const Vec3 spin = turn(step);
  return sum_(motion_.nodes.size(), pool, [&](std::size_t begin, std::size_t end, int) {
    double power = 0.0;  // W, at the new velocity more than at the old one
    const auto set = [&](double& velocity, double wanted, double force) {
      power += force * (wanted - velocity);
      velocity = wanted;
    };
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t node = index_of(motion_.nodes[i]);
      const Vec3 velocity = (start_[i] + way - state.position[node]) / step.after;
      for (int axis = 0; axis < 3; ++axis) {
        if (holds_along(motion_.held, axis))
          set(state.velocity[node][axis], velocity[axis], forces.force[node][axis]);
        if (holds_about(motion_.held, axis))
          set(state.angular_velocity[node][axis], spin[axis], forces.torque[node][axis]);
      }
    }
    return 0.5 * step.before * power;
  });
}

double MovedNodes::largest_speed() const noexcept {
  return motion_.factor.largest_slope() * motion_.displacement.norm() +
         motion_.factor.largest() * motion_.velocity.norm();
}

}  // namespace plekton::dynamics
