// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/plane_servo.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::dynamics {

using contact::Plane;

double plate_area(const PlaneServo& servo, std::span<const Plane> planes) {
  double area = servo.area;
  for (const auto& [a, b] : servo.between)
    area *= std::abs((planes[b].point - planes[a].point).dot(planes[a].normal));
  return area;
}

double servo_speed(const PlaneServo& servo, double missing, double stiffness, double dt) {
  if (!(stiffness > 0.0)) return missing > 0.0 ? servo.largest_speed : 0.0;
  const double speed = servo.gain * missing / (stiffness * dt);
  return std::clamp(speed, -servo.largest_speed, servo.largest_speed);
}

DrivenPlanes::DrivenPlanes(const Loads& loads, std::span<const Plane> at_start)
    : motions_(loads.plane_motions), servos_(loads.servos) {
  for (const PlaneMotion& motion : motions_) start_.push_back(at_start[motion.plane].point);
}

double DrivenPlanes::act(const LoadStep& step, std::span<const PlaneReaction> reactions,
                         std::vector<Plane>& planes) const {
  double power = 0.0;  // W, at the new velocities more than at the old ones
  const auto set = [&](std::size_t plane, const Vec3& velocity) {
    power += reactions[plane].force.dot(velocity - planes[plane].velocity);
    planes[plane].velocity = velocity;
  };
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const PlaneMotion& motion = motions_[i];
    const Vec3 place = start_[i] + motion.factor.integral(step.time + step.after) * motion.velocity;
    set(motion.plane, (place - planes[motion.plane].point) / step.after);
  }
  for (const PlaneServo& servo : servos_) {
    const Plane& plane = planes[servo.plane];
    const double wanted =
        servo.factor.at(step.time) * (servo.force + servo.pressure * plate_area(servo, planes));
    const PlaneReaction& felt = reactions[servo.plane];
    const double pressing = -felt.force.dot(plane.normal);
    const double speed = servo_speed(servo, wanted - pressing, felt.stiffness, step.after);
    const Vec3 across = plane.velocity - plane.velocity.dot(plane.normal) * plane.normal;
    set(servo.plane, across + speed * plane.normal);
  }
  return 0.5 * step.before * power;
}

double DrivenPlanes::largest_speed() const noexcept {
  double speed = 0.0;
  for (const PlaneMotion& motion : motions_)
    speed = std::max(speed, motion.factor.largest() * motion.velocity.norm());
  for (const PlaneServo& servo : servos_) speed = std::max(speed, servo.largest_speed);
  return speed;
}

}  // namespace plekton::dynamics
