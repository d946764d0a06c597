// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contacts.hpp"
#include "dynamics/loads/plane_servo.hpp"
#include "dynamics/model/loads.hpp"
#include "dynamics/state/rigid_nodes.hpp"

#include <span>
#include <vector>

namespace plekton::dynamics {

/// What a rigid body would bear along a direction if it were further along that, and all others
/// stayed where they are: its contacts of now, each with its present stiffness, and those that it
/// comes to on the way.
class BodyPress {
 public:
  /// A way of a body.
  struct Way {
    std::int32_t body;
    Vec3 direction;  ///< unit
    double longest;  ///< m, that is asked for at most
  };
  /// Looks at the contacts of a body.
  void look(const contact::Contacts& contacts, const RigidNodes& rigid, const Way& way,
            std::span<const contact::Plane> planes, geometry::Positions x);

  /// @param way  m
  PlanePress at(double way) const noexcept;

 private:
  /// A contact that the way makes deeper.
  struct Spring {
    double slope;      ///< m of overlap over m of way; below 0 where it parts
    double gap;        ///< m
    double force;      ///< N, of now
    double stiffness;  ///< N/m
    double damping;    ///< N s/m, of now
  };
  std::vector<Spring> springs_;
};

/// Rigid bodies that are pressed on others along an axis of the world.
class DrivenBodies {
 public:
  explicit DrivenBodies(const Loads& loads) : servos_(loads.body_servos) {}

  bool empty() const noexcept { return servos_.empty(); }

  /// Sets the velocities of the bodies along their axes, for the drift that begins now.
  /// @param felt     (body) -> force (N) of contacts alone
  /// @param look_at  (servo, longest way (m)) -> how its body would be pressed on the way
  /// @returns the work (J) over half of the drift before, as far as the velocity there was another
  template <class Felt, class LookAt>
  double act(const LoadStep& step, const Felt& felt, const NodeForces& forces,
             const RigidNodes& rigid, NodeState& state, const LookAt& look_at) const {
    double work = 0.0;
    for (const BodyServo& servo : servos_) {
      const auto body = static_cast<std::int32_t>(servo.body);
      const std::size_t node = index_of(rigid.reference(body));
      const Vec3 direction = direction_of(servo);
      const double wanted =
          servo.factor.at(step.time) * (servo.force + servo.pressure * servo.area);
      const double pressing = -felt(servo.body).dot(direction);
      const BodyPress& press = look_at(servo, servo.largest_speed * step.after);
      double& velocity = state.velocity[node][servo.axis];
      const ServoPace pace{servo.largest_speed, servo.gain};
      const ServoPlate plate{wanted, pressing, servo.towards * velocity};
      const double speed = servo_speed(
          pace, plate, [&](double way) { return press.at(way); }, step.after);
      const double now = servo.towards * speed;
      work += 0.5 * step.before * forces.force[node][servo.axis] * (now - velocity);
      velocity = now;
    }
    return work;
  }

  /// m/s, of all times.
  double largest_speed() const noexcept;

  static Vec3 direction_of(const BodyServo& servo) noexcept {
    return servo.towards * Vec3::Unit(servo.axis);
  }

 private:
  std::vector<BodyServo> servos_;
};

}  // namespace plekton::dynamics
