// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/plane_servo.hpp"

#include "dynamics/model/require_index.hpp"
#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace plekton::dynamics {

using contact::Plane;

double plate_area(double area, std::span<const std::array<std::size_t, 2>> between,
                  std::span<const Plane> planes) {
  for (const auto& [a, b] : between)
    area *= std::abs((planes[b].point - planes[a].point).dot(planes[a].normal));
  return area;
}

bool bound_a_plate(const Vec3& normal_a, const Vec3& normal_b, const Vec3& direction) noexcept {
  constexpr double kTolerance = 1e-9;  // of unit vectors
  return std::abs(normal_a.cross(normal_b).dot(direction)) > kTolerance;
}

void require_target(std::string_view call, double force, double pressure) {
  if (std::isfinite(force) && std::isfinite(pressure) && force >= 0.0 && pressure >= 0.0 &&
      force + pressure > 0.0)
    return;
  throw std::invalid_argument(std::string(call) + ": got " + std::to_string(force) + " and " +
                              std::to_string(pressure) +
                              "; expected finite targets, none below 0, one of them above");
}

double full_target(const PlaneServo& servo, std::span<const Plane> planes) {
  const Plane& plane = planes[servo.plane];
  const bool is_side = plane.form == Plane::Form::cylinder && !servo.between.empty();
  const double around = is_side ? 2.0 * std::numbers::pi * plane.radius : 1.0;  // m, or 1
  return servo.force + servo.pressure * around * plate_area(servo.area, servo.between, planes);
}

double full_target(const BodyServo& servo, std::span<const Plane> planes) {
  if (servo.turns()) return servo.torque;
  return servo.force + servo.pressure * plate_area(servo.area, servo.between, planes);
}

namespace {

/// The way (m) in (0, longest] by which a force grows by so much (N), or longest if it grows by
/// less. Newton's method: of contacts that get no softer each tangent lies below, so it comes from
/// above and ends after as many steps as contacts begin on the way. Where one leaves the interval
/// known to hold the answer, that is halved.
/// @param stiffness  N/m, at 0
double way_to_press(double growth, double longest, const PlanePress& now,
                    const std::function<PlanePress(double way)>& press) {
  constexpr int kMostLooks = 30;
  constexpr double kEnough = 1e-3;  // of the growth
  double low = 0.0, high = longest;
  double way = now.stiffness > 0.0 ? std::min(longest, growth / now.stiffness) : longest;
  for (int i = 0; i < kMostLooks; ++i) {
    const PlanePress then = press(way);
    const double excess = then.force - now.force - growth;
    if (std::abs(excess) <= kEnough * growth) return way;
    (excess > 0.0 ? high : low) = way;
    if (!(low < high)) return high;
    const double next = then.stiffness > 0.0 ? way - excess / then.stiffness : longest;
    way = next > low && next < high ? next : 0.5 * (low + high);
    if (high - low <= kEnough * high) return low;
  }
  return low;
}

/// The way (m) of a plate that touches nothing now, to bodies where they are now or will be.
double way_to_meet(double growth, double longest, const PressOfWay& press, ServoTime when) {
  constexpr double kTouch = 1e-3;  // of the force it would press with
  const PlanePress still = press(0.0, when);
  if (still.force > kTouch * growth) return 0.0;
  return way_to_press(kTouch * growth, longest, still,
                      [&](double way) { return press(way, when); });
}

}  // namespace

double servo_speed(const ServoPace& pace, const ServoPlate& plate, const PressOfWay& press,
                   double dt) {
  const double longest = pace.largest_speed * dt;
  PlanePress now = press(0.0, ServoTime::now);
  const double of_last = now.damping * plate.speed;
  const double of_dashpots = plate.felt - now.force;
  const double change =
      pace.gain * (plate.wanted - plate.felt +
                   (of_last < 0.0 ? std::max(of_last, std::min(of_dashpots, 0.0)) : of_last));
  if (!(now.stiffness > 0.0)) {
    if (!(change > 0.0)) return 0.0;
    return std::min(way_to_meet(change, longest, press, ServoTime::now),
                    way_to_meet(change, longest, press, ServoTime::after_drift)) /
           dt;
  }
  // The dashpots resist a way in a drift as springs do.
  const double drag = pace.gain * now.damping / dt;
  now.stiffness += drag;
  const auto resisted = [&press, drag](double way) {
    PlanePress there = press(way, ServoTime::now);
    there.force += drag * way;
    there.stiffness += drag;
    return there;
  };
  if (change > 0.0) return way_to_press(change, longest, now, resisted) / dt;
  return std::max(change / now.stiffness, -longest) / dt;
}

DrivenPlanes::DrivenPlanes(const Loads& loads, std::span<const Plane> at_start)
    : motions_(loads.plane_motions), servos_(loads.servos) {
  for (const PlaneMotion& motion : motions_)
    start_.push_back(motion.start.value_or(at_start[motion.plane].point));
}

double DrivenPlanes::act(const LoadStep& step, std::span<const PlaneReaction> reactions,
                         const PlanePressAt& press, std::vector<Plane>& planes) {
  double power = 0.0;  // W, at the new velocities more than at the old ones
  const auto set = [&](std::size_t plane, const Vec3& velocity) {
    power += reactions[plane].force.dot(velocity - planes[plane].velocity);
    planes[plane].velocity = velocity;
  };
  const auto close = [&](std::size_t plane, double speed) {
    power += reactions[plane].push * (-speed - planes[plane].widening);
    planes[plane].widening = -speed;
  };
  for (const auto& [plane, velocity] : set_velocities_) set(plane, velocity);
  set_velocities_.clear();
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const PlaneMotion& motion = motions_[i];
    const Vec3 place = start_[i] + motion.factor.integral(step.time + step.after) * motion.velocity;
    set(motion.plane, (place - planes[motion.plane].point) / step.after);
  }
  for (const PlaneServo& servo : servos_) {
    const Plane& plane = planes[servo.plane];
    const double wanted = servo.factor.at(step.time) * full_target(servo, planes);
    const bool is_flat = plane.form == Plane::Form::flat;
    const double pressing = reactions[servo.plane].pressing(plane);
    const auto press_here = [&](double way, ServoTime when) {
      return press(servo.plane, way, when);
    };
    const ServoPlate now{wanted, pressing,
                         is_flat ? plane.velocity.dot(plane.normal) : -plane.widening};
    // A container closes by a part of what is left, never altogether.
    constexpr double kLargestPart = 0.5;  // of the radius, in a drift
    const double largest =
        is_flat ? servo.largest_speed
                : std::min(servo.largest_speed, kLargestPart * plane.radius / step.after);
    const double speed = servo_speed({largest, servo.gain}, now, press_here, step.after);
    if (!is_flat) {
      close(servo.plane, speed);
      continue;
    }
    const Vec3 across = plane.velocity - plane.velocity.dot(plane.normal) * plane.normal;
    set(servo.plane, across + speed * plane.normal);
  }
  return 0.5 * step.before * power;
}

void DrivenPlanes::set_target(std::size_t servo, double force, double pressure) {
  require_index("set_servo", "servo", servo, servos_.size());
  require_target("set_servo", force, pressure);
  keep_target(servo, force, pressure);
}

void DrivenPlanes::keep_target(std::size_t servo, double force, double pressure) {
  servos_[servo].force = force;
  servos_[servo].pressure = pressure;
  if (std::find(set_servos_.begin(), set_servos_.end(), servo) == set_servos_.end())
    set_servos_.push_back(servo);
}

void DrivenPlanes::set_velocity(std::size_t plane, const Vec3& velocity) {
  if (drives(plane))
    throw std::invalid_argument("set_plane_velocity: plane " + std::to_string(plane) +
                                " is moved by a load; change that, or leave it out");
  if (!velocity.allFinite())
    throw std::invalid_argument("set_plane_velocity: the velocity must be finite");
  set_velocities_.push_back({plane, velocity});
}

bool DrivenPlanes::drives(std::size_t plane) const noexcept {
  const auto is_it = [plane](const auto& driven) { return driven.plane == plane; };
  return std::ranges::any_of(motions_, is_it) || std::ranges::any_of(servos_, is_it);
}

void DrivenPlanes::require_same_kind(const geometry::StateArchive& archive) const {
  std::vector<std::size_t> driven;
  for (const PlaneMotion& motion : motions_) driven.push_back(motion.plane);
  for (const PlaneServo& servo : servos_) driven.push_back(servo.plane);
  archive("driven", driven);
  for (const std::size_t plane : driven) {
    if (drives(plane)) continue;
    throw geometry::StateMismatch(
        "the state was that of a scene whose plane " + std::to_string(plane) +
        " (by place) a load moves, which would go on at the speed of its last step here, where no "
        "load moves it: give it a load here too");
  }
}

void DrivenPlanes::exchange(const geometry::StateArchive& archive, std::size_t plane_count) {
  require_same_kind(archive);
  struct Target {
    std::size_t servo = 0;
    double force = 0.0, pressure = 0.0;
  };
  std::vector<Target> targets;
  for (const std::size_t i : set_servos_)
    targets.push_back({i, servos_[i].force, servos_[i].pressure});
  archive.rows("set_targets", targets, [&](geometry::RowFields& row, Target& target) {
    row("servo", target.servo);
    row.require(target.servo < servos_.size(), "servo");
    row("force", target.force);
    row("pressure", target.pressure);
    row.require(target.force >= 0.0 && std::isfinite(target.force) && target.pressure >= 0.0 &&
                    std::isfinite(target.pressure),
                "force");
    if (row.is_reading()) keep_target(target.servo, target.force, target.pressure);
  });
  archive.rows("set_velocities", set_velocities_, [&](geometry::RowFields& row, SetVelocity& set) {
    row("plane", set.plane);
    row.require(set.plane < plane_count && !drives(set.plane), "plane");
    row("velocity", set.velocity);
    row.require(set.velocity.allFinite(), "velocity");
  });
}

double DrivenPlanes::largest_speed(const TimeSpan& during) const noexcept {
  double speed = 0.0;
  for (const PlaneMotion& motion : motions_)
    speed = std::max(speed, motion.factor.largest(during) * motion.velocity.norm());
  for (const PlaneServo& servo : servos_) speed = std::max(speed, servo.largest_speed);
  for (const auto& [plane, velocity] : set_velocities_) speed = std::max(speed, velocity.norm());
  return speed;
}

double DrivenPlanes::largest_speed_of_others(std::span<const Plane> planes) const noexcept {
  double fastest = 0.0;
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (!drives(i)) fastest = std::max(fastest, planes[i].speed());
  return fastest;
}

}  // namespace plekton::dynamics
