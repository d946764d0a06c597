// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/wall_collisions.hpp"

#include <cmath>
#include <limits>

namespace plekton::dynamics {

void WallCollisions::collect(const ContactSprings& springs, const NodeState& state) {
  falls_.assign(state.size(), Fall{});
  springs.for_each_on_wall([&](const ContactStiffness& contact, const SpringEnd& end) {
    const std::size_t node = index_of(end.node);
    Vec3 velocity = state.velocity[node];  // of the core point: the ball around it may turn
    if (rigid_->body_at(end.node) >= 0) velocity += state.angular_velocity[node].cross(end.lever);
    const double speed = contact.wall_speed - contact.normal.dot(velocity);
    const double stiffness = contact.elastic_stiffness();
    const Vec3 push = stiffness * speed * contact.normal;
    Fall& fall = falls_[node];
    fall.push += push;
    fall.turn += end.lever.cross(push);
    fall.power += stiffness * speed * speed;
    fall.stored += 0.5 * stiffness * contact.overlap * contact.overlap;
  });
}

/// J/s⁴, f M^-1 f of a node or rigid body.
double WallCollisions::answer(NodeId node, const NodeProperties& properties) const {
  const Fall& fall = falls_[index_of(node)];
  const Vec3 free = free_axes(properties.held[index_of(node)]).cwiseProduct(fall.push);
  double answer = free.squaredNorm() / properties.mass[index_of(node)];
  if (const std::int32_t body = rigid_->body_at(node); body >= 0)
    answer += (rigid_->turn_root(body).transpose() * fall.turn).squaredNorm();
  return answer;
}

double WallCollisions::step(const ContactSprings& springs, const NodeState& state,
                            const NodeProperties& properties) {
  collect(springs, state);
  double energy = 0.0;  // J, of what is about to begin or end
  double rated = 0.0;   // J/s², of what is more than stored, times omega²
  for (std::size_t i = 0; i < falls_.size(); ++i) {
    const Fall& fall = falls_[i];
    if (!(fall.power > 0.0)) continue;
    const double squared = answer(geometry::id_at<NodeId>(i), properties) / fall.power;
    if (!(squared > 0.0)) continue;
    const double moving = 0.5 * fall.power / squared;
    if (!(moving > fall.stored)) continue;
    energy += moving + fall.stored;
    rated += (moving - fall.stored) * squared;
  }
  return rated > 0.0 ? 0.5 * std::sqrt(energy / rated) : std::numeric_limits<double>::infinity();
}

}  // namespace plekton::dynamics
