// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/rigid_servo.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::dynamics {

void BodyPress::look(const contact::Contacts& contacts, const RigidNodes& rigid, const Way& way,
                     std::span<const contact::Plane> planes, geometry::Positions x) {
  springs_.clear();
  const auto is_own = [&](NodeId node) { return rigid.body_followed_by(node) == way.body; };
  // Of a law that gets stiffer with the overlap as stiff as it may get on the way.
  const auto add = [&](double slope, double gap, double weight, const contact::PairSprings& pair,
                       double dashpot = 1.0) {
    const double stiffness =
        pair.stiffness(std::min(gap, 0.0) - std::abs(slope) * way.longest).normal;
    const double damping = gap < 0.0 ? dashpot * pair.stiffness(gap).normal_damping : 0.0;
    springs_.push_back({slope, gap, weight * pair.normal_force(gap), weight * stiffness, damping});
  };
  contacts.for_each_near_sphere_pair(
      way.longest, x, [&](NodeId a, NodeId b, const contact::PairSprings& pair, double gap) {
        if (is_own(a) == is_own(b)) return;
        const double along = way.direction.dot(Vec3(x[index_of(b)] - x[index_of(a)]).normalized());
        add(is_own(a) ? along : -along, gap, 1.0, pair);
      });
  const auto add_on_surface = [&](NodeId ball, const geometry::CorePoint& core,
                                  const contact::PairSprings& pair, double range,
                                  const contact::TermPart& part) {
    const bool is_ball = is_own(ball);
    if (is_ball == is_own(core.nodes[0])) return;
    const Vec3 to_core = geometry::position(core, x) - x[index_of(ball)];
    const double distance = to_core.norm();
    if (!(distance > 0.0)) return;
    const double gap = distance - range;
    const double along = way.direction.dot(to_core) / distance;
    const double of_one = pair.normal_force(gap);
    const double weight = of_one > 0.0 && part.elastic != 0.0 ? part.elastic / of_one : 1.0;
    add(is_ball ? along : -along, gap, weight, pair, part.dashpot);
  };
  contacts.for_each_surface_term(add_on_surface);
  contacts.for_each_coming_surface_term(way.longest, x, add_on_surface);
  contacts.for_each_near_plane_pair(
      way.longest, planes, x,
      [&](NodeId ball, std::size_t plane, const contact::PairSprings& pair, double gap) {
        if (is_own(ball)) add(-way.direction.dot(planes[plane].normal), gap, 1.0, pair);
      });
  contacts.for_each_structure_stiffness(
      [&](NodeId node, const contact::PairStiffness& stiffness, double) {
        if (is_own(node))
          springs_.push_back({1.0, 0.0, 0.0, stiffness.normal, stiffness.normal_damping});
      });
}

PlanePress BodyPress::at(double way) const noexcept {
  PlanePress press;
  for (const Spring& spring : springs_) {
    const double deeper = spring.slope * way;
    if (deeper < spring.gap) continue;
    const double force = spring.gap > 0.0 ? spring.stiffness * (deeper - spring.gap)
                                          : spring.force + spring.stiffness * deeper;
    press.force += spring.slope * std::max(0.0, force);
    press.stiffness += spring.slope * spring.slope * spring.stiffness;
    press.damping += spring.slope * spring.slope * spring.damping;
  }
  return press;
}

double DrivenBodies::largest_speed() const noexcept {
  double speed = 0.0;
  for (const BodyServo& servo : servos_) speed = std::max(speed, servo.largest_speed);
  return speed;
}

}  // namespace plekton::dynamics
