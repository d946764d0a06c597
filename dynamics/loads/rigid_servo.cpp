// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/rigid_servo.hpp"

#include "dynamics/model/require_index.hpp"
#include "dynamics/model/scene_figures.hpp"
#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace plekton::dynamics {

void BodyPress::look(const contact::Contacts& contacts, const RigidNodes& rigid, const Way& way,
                     std::span<const contact::Plane> planes, geometry::Positions x) {
  springs_.clear();
  const View view{contacts, rigid, way, x};
  look_at_spheres(view);
  look_at_surfaces(view);
  look_at_planes(view, planes);
  look_at_structures(view);
}

void BodyPress::look_at_spheres(const View& view) {
  const Way& way = view.way;
  const geometry::Positions x = view.x;
  view.contacts.for_each_near_sphere_pair(
      way.longest_path(), x, [&](NodeId a, NodeId b, const contact::PairSprings& pair, double gap) {
        if (view.is_own(a) == view.is_own(b)) return;
        const Vec3& own = x[index_of(view.is_own(a) ? a : b)];
        const Vec3 normal = Vec3(x[index_of(b)] - x[index_of(a)]).normalized();
        const double along = way.motion_at(own).dot(normal);
        add(way,
            {{x[index_of(a)], x[index_of(b)]}, normal, view.is_own(a) ? along : -along, gap, 1.0},
            pair);
      });
}

void BodyPress::look_at_surfaces(const View& view) {
  const Way& way = view.way;
  const geometry::Positions x = view.x;
  const auto add_on_surface = [&](NodeId ball, const geometry::CorePoint& core,
                                  const contact::PairSprings& pair, double range,
                                  const contact::TermPart& part) {
    const bool is_ball = view.is_own(ball);
    if (is_ball == view.is_own(core.nodes[0])) return;
    const Vec3 foot = geometry::position(core, x);
    const Vec3 to_core = foot - x[index_of(ball)];
    const double distance = to_core.norm();
    if (!(distance > 0.0)) return;
    const double gap = distance - range;
    const double along = way.motion_at(is_ball ? x[index_of(ball)] : foot).dot(to_core) / distance;
    const double of_one = pair.normal_force(gap);
    const double weight = of_one > 0.0 && part.elastic != 0.0 ? part.elastic / of_one : 1.0;
    add(way,
        {{x[index_of(ball)], foot},
         to_core / distance,
         is_ball ? along : -along,
         gap,
         weight,
         part.dashpot},
        pair);
  };
  view.contacts.for_each_surface_term(add_on_surface);
  view.contacts.for_each_coming_surface_term(way.longest_path(), x, add_on_surface);
}

void BodyPress::look_at_planes(const View& view, std::span<const contact::Plane> planes) {
  const Way& way = view.way;
  const geometry::Positions x = view.x;
  view.contacts.for_each_near_plane_pair(
      way.longest_path(), planes, x,
      [&](NodeId ball, std::size_t plane, const contact::PairSprings& pair, double gap) {
        if (!view.is_own(ball)) return;
        const Vec3& place = x[index_of(ball)];
        const Vec3 normal = planes[plane].normal_at(place);
        const Vec3 foot = planes[plane].foot(place);
        add(way, {{foot, foot}, normal, -way.motion_at(place).dot(normal), gap, 1.0}, pair);
      });
}

void BodyPress::look_at_structures(const View& view) {
  view.contacts.for_each_structure_stiffness([&](NodeId node,
                                                 const contact::PairStiffness& stiffness, double) {
    if (!view.is_own(node)) return;
    const double slope = view.way.turn ? view.way.motion_at(view.x[index_of(node)]).norm() : 1.0;
    springs_.push_back({slope, 0.0, 0.0, stiffness.normal, stiffness.normal_damping});
  });
}

/// Of a law that gets stiffer with the overlap as stiff as it may get on the way.
void BodyPress::add(const Way& way, const Touch& touch, const contact::PairSprings& pair) {
  const double gap = touch.gap;
  const double stiffness =
      pair.stiffness(std::min(gap, 0.0) - std::abs(touch.slope) * way.longest).normal;
  const double damping = gap < 0.0 ? touch.dashpot * pair.stiffness(gap).normal_damping : 0.0;
  springs_.push_back(
      {touch.slope, gap, touch.weight * pair.normal_force(gap), touch.weight * stiffness, damping});
  if (way.turn && gap < 0.0) add_dragged(way, touch, pair);
}

/// What a turn drags along the surfaces, by the longer one of two levers.
void BodyPress::add_dragged(const Way& way, const Touch& touch, const contact::PairSprings& pair) {
  double slope = 0.0;
  for (const Vec3& place : touch.places) {
    const Vec3 motion = way.motion_at(place);
    slope = std::max(slope, Vec3(motion - motion.dot(touch.normal) * touch.normal).norm());
  }
  springs_.push_back({slope, 0.0, 0.0, touch.weight * pair.stiffness(touch.gap).tangential, 0.0});
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

DrivenBodies::DrivenBodies(const Scene& scene, const geometry::Surface& surface)
    : servos_(scene.loads.body_servos) {
  std::vector<double> radii;  // m, of nodes
  for (const BodyServo& servo : servos_) {
    radii_.push_back(0.0);
    if (!servo.turns()) continue;
    if (radii.empty()) radii = node_radii(scene, surface);
    const RigidBody& body = scene.rigid_bodies[servo.body];
    const std::vector<Vec3>& x = scene.state.position;
    for (const NodeId node : body.nodes) {
      const double lever = (x[index_of(node)] - x[index_of(body.node)]).norm();
      radii_.back() = std::max(radii_.back(), lever + radii[index_of(node)]);
    }
  }
}

void DrivenBodies::set_target(std::size_t servo, double target, double pressure) {
  require_index("set_body_servo", "body servo", servo, servos_.size());
  require_target("set_body_servo", target, pressure);
  BodyServo set = servos_[servo];
  if (set.turns() && !(target > 0.0 && pressure == 0.0))
    throw std::invalid_argument("set_body_servo: servo " + std::to_string(servo) +
                                " has a torque; expected one above 0, and no pressure");
  (set.turns() ? set.torque : set.force) = target;
  set.pressure = pressure;
  keep_target(servo, set);
}

void DrivenBodies::keep_target(std::size_t servo, const BodyServo& target) {
  servos_[servo] = target;
  if (std::find(set_servos_.begin(), set_servos_.end(), servo) == set_servos_.end())
    set_servos_.push_back(servo);
}

void DrivenBodies::exchange(const geometry::StateArchive& archive) {
  struct Target {
    std::size_t servo = 0;
    double force = 0.0, pressure = 0.0, torque = 0.0;
  };
  std::vector<Target> targets;
  for (const std::size_t i : set_servos_)
    targets.push_back({i, servos_[i].force, servos_[i].pressure, servos_[i].torque});
  archive.rows("set_targets", targets, [&](geometry::RowFields& row, Target& target) {
    row("servo", target.servo);
    row.require(target.servo < servos_.size(), "servo");
    for (const auto& [name, value] :
         {std::pair("force", &target.force), std::pair("pressure", &target.pressure),
          std::pair("torque", &target.torque)}) {
      row(name, *value);
      row.require(*value >= 0.0 && std::isfinite(*value), name);
    }
    if (!row.is_reading()) return;
    BodyServo servo = servos_[target.servo];
    servo.force = target.force;
    servo.pressure = target.pressure;
    servo.torque = target.torque;
    keep_target(target.servo, servo);
  });
}

double DrivenBodies::largest_speed() const noexcept {
  double speed = 0.0;
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    const double of_way = servos_[i].turns() ? radii_[i] : 1.0;
    speed = std::max(speed, servos_[i].largest_speed * of_way);
  }
  return speed;
}

}  // namespace plekton::dynamics
