// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contacts.hpp"
#include "dynamics/loads/plane_servo.hpp"
#include "dynamics/model/loads.hpp"
#include "dynamics/model/scene.hpp"
#include "dynamics/state/rigid_nodes.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace plekton::dynamics {

/// What a rigid body would bear along a direction if it were further along that, and all others
/// stayed where they are: its contacts of now, each with its present stiffness, and those that it
/// comes to on the way. Or what torque it would bear if it were turned further about an axis: there
/// contacts count with their levers, and what touches with its tangential stiffness too, as if
/// nothing slid.
class BodyPress {
 public:
  /// A way of a body: along a direction, or a turn about an axis.
  struct Way {
    /// Of a turn.
    struct Turn {
      Vec3 centre;    ///< m, on the axis
      double radius;  ///< m, how far anything of the body is from the centre at most
    };
    std::int32_t body;
    Vec3 direction;  ///< unit, that of the axis where it turns
    double longest;  ///< m, or rad where it turns, that is asked for at most
    std::optional<Turn> turn;

    /// How far what is at a place (m) goes, over the way.
    Vec3 motion_at(const Vec3& place) const noexcept {
      return turn ? direction.cross(place - turn->centre) : direction;
    }
    /// m, that anything of the body goes at most
    double longest_path() const noexcept { return turn ? turn->radius * longest : longest; }
  };
  /// Looks at the contacts of a body.
  void look(const contact::Contacts& contacts, const RigidNodes& rigid, const Way& way,
            std::span<const contact::Plane> planes, geometry::Positions x);

  /// @param way  m, or rad where it turns: the force is a torque (N m) then
  PlanePress at(double way) const noexcept;

 private:
  /// A contact that the way makes deeper.
  struct Spring {
    double slope;      ///< m of overlap over the way; below 0 where it parts
    double gap;        ///< m
    double force;      ///< N, of now
    double stiffness;  ///< N/m
    double damping;    ///< N s/m, of now
  };
  /// What a look is at.
  struct View {
    const contact::Contacts& contacts;
    const RigidNodes& rigid;
    const Way& way;
    geometry::Positions x;
    bool is_own(NodeId node) const noexcept { return rigid.body_followed_by(node) == way.body; }
  };
  /// Two bodies that touch or come to.
  struct Touch {
    std::array<Vec3, 2> places;  ///< m, of both; of a plane twice its nearest point
    Vec3 normal;                 ///< unit, either way round
    double slope;                ///< m of overlap over the way
    double gap;                  ///< m
    double weight;               ///< of one contact
    double dashpot = 1.0;        ///< contacts that damp
  };
  void look_at_spheres(const View& view);
  void look_at_surfaces(const View& view);
  void look_at_planes(const View& view, std::span<const contact::Plane> planes);
  void look_at_structures(const View& view);
  void add(const Way& way, const Touch& touch, const contact::PairSprings& pair);
  void add_dragged(const Way& way, const Touch& touch, const contact::PairSprings& pair);

  std::vector<Spring> springs_;
};

/// Rigid bodies that are pressed on others along an axis of the world, or turned about one.
class DrivenBodies {
 public:
  /// @param scene  at the start
  DrivenBodies(const Scene& scene, const geometry::Surface& surface);

  bool empty() const noexcept { return servos_.empty(); }

  /// By place in Loads::body_servos, from the next act() on.
  /// @param target  N, or N m of one that turns, which has no pressure
  /// @throws std::out_of_range; std::invalid_argument for what require_target() refuses
  void set_target(std::size_t servo, double target, double pressure);
  /// With targets as they are set.
  const std::vector<BodyServo>& servos() const noexcept { return servos_; }
  /// Targets that have been set. @throws geometry::StateMismatch
  void exchange(const geometry::StateArchive& archive);

  /// Sets the velocities of the bodies along or about their axes, for the drift that begins now.
  /// @param felt     (servo) -> force (N), or torque (N m) of one that turns, on the nodes of
  ///                 the body
  /// @param look_at  (way) -> how its body would be pressed on the way
  /// @returns the work (J) over half of the drift before, as far as the velocity there was another
  template <class Felt, class LookAt>
  double act(const LoadStep& step, const Felt& felt, const NodeForces& forces,
             const RigidNodes& rigid, std::span<const contact::Plane> planes, NodeState& state,
             const LookAt& look_at) const {
    double work = 0.0;
    for (std::size_t i = 0; i < servos_.size(); ++i) {
      const BodyServo& servo = servos_[i];
      const auto body = static_cast<std::int32_t>(servo.body);
      const std::size_t node = index_of(rigid.reference(body));
      const Vec3 direction = direction_of(servo);
      const double wanted = servo.factor.at(step.time) * full_target(servo, planes);
      const double pressing = -felt(servo).dot(direction);
      BodyPress::Way way{body, direction, servo.largest_speed * step.after, {}};
      if (servo.turns()) way.turn = {state.position[node], radii_[i]};
      const BodyPress& press = look_at(way);
      double& velocity =
          (servo.turns() ? state.angular_velocity : state.velocity)[node][servo.axis];
      const Vec3& load = (servo.turns() ? forces.torque : forces.force)[node];
      const ServoPace pace{servo.largest_speed, servo.gain};
      const ServoPlate plate{wanted, pressing, servo.towards * velocity};
      const double speed = servo_speed(
          pace, plate, [&](double along, ServoTime) { return press.at(along); }, step.after);
      const double now = servo.towards * speed;
      work += 0.5 * step.before * load[servo.axis] * (now - velocity);
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
  void keep_target(std::size_t servo, const BodyServo& target);

  std::vector<BodyServo> servos_;
  std::vector<std::size_t> set_servos_;
  std::vector<double> radii_;  ///< m, of the bodies of servos that turn; 0 of others
};

}  // namespace plekton::dynamics
