// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/stiffness/contact_springs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plekton::dynamics {

void ContactSprings::clear() noexcept {
  contacts_ = 0;
  springs_.clear();
  ends_.clear();
  single_.clear();
}

void ContactSprings::add_spring(const ContactStiffness& contact, std::span<const SpringEnd> ends,
                                Kind kind) {
  Spring spring{contact, ends_.size(), 0, kind};
  for (const SpringEnd& end : ends) {
    if (end.weight != 0.0) ends_.push_back(end);
  }
  spring.end_count = ends_.size() - spring.first_end;
  springs_.push_back(spring);
  if (kind != Kind::turning) ++contacts_;
}

void ContactSprings::add_pair(NodeId a, NodeId b, const ContactStiffness& contact) {
  add_spring(contact,
             std::array{on_body({a, -1.0, contact.arm_a}, rigid_),
                        on_body({b, 1.0, -contact.arm_b}, rigid_)},
             Kind::of_balls);
}

void ContactSprings::add_on_surface(NodeId ball, const geometry::CorePoint& core,
                                    const ContactStiffness& contact,
                                    const SurfaceTurning& turning) {
  std::array ends = surface_ends(ball, core, contact);
  put_on_bodies(ends, rigid_);
  add_spring(contact, ends, Kind::on_surface);
  TurningSpring spring = turning_spring(ball, core, contact.normal, turning);
  if (!(spring.contact.normal_stiffness > 0.0)) return;
  for (SpringEnd& end : spring.ends) end = on_body(end, rigid_);
  add_spring(spring.contact, spring.ends, Kind::turning);
}

void ContactSprings::add_to_wall(NodeId ball, const ContactStiffness& contact) {
  add_spring(contact, std::array{on_body({ball, -1.0, contact.arm_a}, rigid_)}, Kind::on_wall);
}

void ContactSprings::add(NodeId node, const IsotropicStiffness& springs) {
  single_.push_back({node, springs});
}

ContactSprings::Approach ContactSprings::approach_of(const Spring& spring, const NodeState& state,
                                                     const NodeProperties& properties) const {
  Approach approach;
  const Vec3& n = spring.contact.normal;
  for (const SpringEnd& end : ends().subspan(spring.first_end, spring.end_count)) {
    const std::size_t node = index_of(end.node);
    approach.speed += end.weight * n.dot(state.velocity[node]);
    if (rigid_ != nullptr && rigid_->body_at(end.node) >= 0) {
      const Mat3 of_point = rigid_->point_mobility(rigid_->body_at(end.node), end.lever);
      approach.speed += end.weight * n.dot(state.angular_velocity[node].cross(end.lever));
      approach.mobility += end.weight * end.weight * n.dot(of_point * n);
    } else if (!holds_translation(properties.held[node])) {
      approach.mobility += end.weight * end.weight / properties.mass[node];
    }
  }
  if (!(approach.mobility > 0.0)) return approach;
  const double overlap = spring.contact.overlap;
  approach.stored = 0.5 * spring.contact.elastic_stiffness() * overlap * overlap;
  approach.moving = 0.5 * approach.speed * approach.speed / approach.mobility;
  return approach;
}

double ContactSprings::collision_step(const NodeState& state,
                                      const NodeProperties& properties) const {
  double energy = 0.0;  // J
  double rated = 0.0;   // J/s², energy times omega²
  for (const Spring& spring : springs_) {
    if (spring.kind != Kind::on_surface) continue;
    const Approach approach = approach_of(spring, state, properties);
    energy += approach.energy();
    rated += approach.energy() * spring.contact.elastic_stiffness() * approach.mobility;
  }
  return rated > 0.0 ? 0.5 * std::sqrt(energy / rated) : std::numeric_limits<double>::infinity();
}

double ContactSprings::crossing_step(const NodeState& state,
                                     const NodeProperties& properties) const {
  double energy = 0.0;  // J
  double power = 0.0;   // W
  for (const Spring& spring : springs_) {
    if (!(spring.contact.core_force > 0.0)) continue;
    const Approach approach = approach_of(spring, state, properties);
    if (!(approach.mobility > 0.0)) continue;  // of what is moved or held nothing is lost
    energy += approach.energy();
    power += spring.contact.core_force * std::max(0.0, -approach.speed);
  }
  return power > 0.0 ? energy / (16.0 * power) : std::numeric_limits<double>::infinity();
}

double ContactSprings::ending_step(const NodeState& state, const NodeProperties& properties) const {
  double energy = 0.0;   // J
  double rated = 0.0;    // J/s², of what motion has more than is stored, times omega²
  double squares = 0.0;  // J²/s⁴, of the same
  for (const Spring& spring : springs_) {
    const Approach approach = approach_of(spring, state, properties);
    energy += approach.energy();
    const double more = std::max(0.0, approach.moving - approach.stored) *
                        spring.contact.elastic_stiffness() * approach.mobility;
    rated += more;
    squares += more * more;
  }
  const double largest = std::max(rated, 16.0 * std::sqrt(squares));
  return largest > 0.0 ? 0.5 * std::sqrt(energy / largest)
                       : std::numeric_limits<double>::infinity();
}

void ContactSprings::resist(const std::vector<Vec3>& shift, const std::vector<Vec3>& turn,
                            NodeForces& forces) const {
  for (const Spring& spring : springs_) {
    if (spring.kind == Kind::turning) continue;
    const Vec3& n = spring.contact.normal;
    Vec3 way = Vec3::Zero();  // m, of the contact point on b less that on a
    for (std::size_t i = spring.first_end; i < spring.first_end + spring.end_count; ++i) {
      const SpringEnd& end = ends_[i];
      way += end.weight *
             (shift[index_of(end.node)] + turn[index_of(end.node)].cross(end.to_contact(n)));
    }
    const Vec3 along = n.dot(way) * n;
    const Vec3 force = spring.contact.normal_stiffness * along +
                       spring.contact.tangential_stiffness * (way - along);
    for (std::size_t i = spring.first_end; i < spring.first_end + spring.end_count; ++i) {
      const SpringEnd& end = ends_[i];
      forces.force[index_of(end.node)] -= end.weight * force;
      forces.torque[index_of(end.node)] -= end.weight * end.to_contact(n).cross(force);
    }
  }
  for (const Single& single : single_) resist_single(single, shift, turn, forces);
}

void ContactSprings::resist_single(const Single& single, const std::vector<Vec3>& shift,
                                   const std::vector<Vec3>& turn, NodeForces& forces) const {
  const SpringEnd end = on_body({single.node, 1.0, 0.0}, rigid_);
  const std::size_t node = index_of(end.node);
  const Vec3 force = single.springs.translation * Vec3(shift[node] + turn[node].cross(end.lever));
  forces.force[node] -= force;
  forces.torque[node] -= end.lever.cross(force) + single.springs.rotation * turn[node];
}

}  // namespace plekton::dynamics
