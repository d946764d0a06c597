// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/prescribed_motion.hpp"

#include "geometry/base/rotation_about.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace plekton::dynamics {

MovedNodes::MovedNodes(const PrescribedMotion& motion, const NodeState& at_start, double lever)
    : motion_(motion), lever_(lever), start_(motion.start) {
  if (!start_.empty()) return;
  for (const NodeId node : motion_.nodes) start_.push_back(at_start.position[index_of(node)]);
}

/// m, from the place at the start.
Vec3 MovedNodes::displacement(double time) const noexcept {
  const double way = motion_.factor.at(time) - motion_.factor.at(motion_.factor.start());
  return way * motion_.displacement + motion_.factor.integral(time) * motion_.velocity;
}

/// About the axis, from the start.
Mat3 MovedNodes::rotation(double time) const {
  if (!motion_.turn) return Mat3::Identity();
  const double share = motion_.factor.at(time) - motion_.factor.at(motion_.factor.start());
  return geometry::rotation_about(motion_.turn->axis, share * motion_.turn->angle);
}

/// m, of the node at a place in motion_.nodes.
Vec3 MovedNodes::place(std::size_t i, const Mat3& rotation, const Vec3& way) const noexcept {
  if (!motion_.turn) return start_[i] + way;
  const Vec3& point = motion_.turn->point;
  return point + rotation * (start_[i] - point) + way;
}

/// rad/s, over the drift that begins now.
Vec3 MovedNodes::spin(const LoadStep& step) const noexcept {
  const double share =
      motion_.factor.integral(step.time + step.after) - motion_.factor.integral(step.time);
  Vec3 angle = share * motion_.angular_velocity;
  if (motion_.turn) {
    const double change = motion_.factor.at(step.time + step.after) - motion_.factor.at(step.time);
    angle += change * motion_.turn->angle * motion_.turn->axis;
  }
  return angle / step.after;
}

void MovedNodes::start(NodeState& state) const {
  const Vec3 velocity = motion_.factor.slope(motion_.factor.start()) * motion_.displacement +
                        motion_.factor.at(motion_.factor.start()) * motion_.velocity;
  Vec3 spin = motion_.factor.at(motion_.factor.start()) * motion_.angular_velocity;
  Vec3 turn = Vec3::Zero();  // rad/s, about the axis
  if (motion_.turn)
    turn = motion_.factor.slope(motion_.factor.start()) * motion_.turn->angle * motion_.turn->axis;
  spin += turn;
  for (std::size_t i = 0; i < motion_.nodes.size(); ++i) {
    const NodeId node = motion_.nodes[i];
    const Vec3 round =
        motion_.turn ? Vec3(turn.cross(start_[i] - motion_.turn->point)) : Vec3(Vec3::Zero());
    for (int axis = 0; axis < 3; ++axis) {
      if (holds_along(motion_.held, axis))
        state.velocity[index_of(node)][axis] = velocity[axis] + round[axis];
      if (holds_about(motion_.held, axis))
        state.angular_velocity[index_of(node)][axis] = spin[axis];
    }
  }
}

double MovedNodes::act(const LoadStep& step, NodeState& state, const NodeForces& forces,
                       geometry::ThreadPool& pool) {
  const Vec3 way = displacement(step.time + step.after);
  const Mat3 turned = rotation(step.time + step.after);
  const Vec3 turning = spin(step);
  return sum_(motion_.nodes.size(), pool, [&](std::size_t begin, std::size_t end, int) {
    double power = 0.0;  // W, at the new velocity more than at the old one
    const auto set = [&](double& velocity, double wanted, double force) {
      power += force * (wanted - velocity);
      velocity = wanted;
    };
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t node = index_of(motion_.nodes[i]);
      const Vec3 velocity = (place(i, turned, way) - state.position[node]) / step.after;
      for (int axis = 0; axis < 3; ++axis) {
        if (holds_along(motion_.held, axis))
          set(state.velocity[node][axis], velocity[axis], forces.force[node][axis]);
        if (holds_about(motion_.held, axis))
          set(state.angular_velocity[node][axis], turning[axis], forces.torque[node][axis]);
      }
    }
    return 0.5 * step.before * power;
  });
}

double MovedNodes::largest_speed(const TimeSpan& during) const noexcept {
  double furthest = 0.0;  // m, from the axis
  for (const Vec3& start : start_) {
    if (motion_.turn)
      furthest = std::max(furthest, motion_.turn->axis.cross(start - motion_.turn->point).norm());
  }
  const double round = motion_.turn ? std::abs(motion_.turn->angle) * (furthest + lever_) : 0.0;
  return motion_.factor.largest_slope(during) * (round + motion_.displacement.norm()) +
         motion_.factor.largest(during) *
             (motion_.velocity.norm() + lever_ * motion_.angular_velocity.norm());
}

double reach_around(std::span<const NodeId> nodes, std::span<const RigidBody> bodies,
                    geometry::Positions x) {
  double furthest = 0.0;
  for (const RigidBody& body : bodies) {
    if (std::ranges::find(nodes, body.node) == nodes.end()) continue;
    for (const NodeId node : body.nodes)
      furthest = std::max(furthest, (x[index_of(node)] - x[index_of(body.node)]).norm());
  }
  return furthest;
}

}  // namespace plekton::dynamics
