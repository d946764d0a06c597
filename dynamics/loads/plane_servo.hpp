// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/bodies.hpp"
#include "dynamics/loads/load_step.hpp"
#include "dynamics/model/loads.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::dynamics {

/// What the bodies do to a plane along its normal by their elasticity, and by the dashpots of those
/// that it touches now.
struct PlanePress {
  double force = 0.0;      ///< N, without dashpots
  double stiffness = 0.0;  ///< N/m
  double damping = 0.0;    ///< N s/m
};
/// Where bodies are: now, or after the drift that begins now.
enum class ServoTime : std::uint8_t { now, after_drift };
/// That of a plane if it were a way (m) further in them.
using PressOfWay = std::function<PlanePress(double way, ServoTime when)>;
using PlanePressAt = std::function<PlanePress(std::size_t plane, double way, ServoTime when)>;

/// How fast a servo may be.
struct ServoPace {
  double largest_speed;  ///< m/s
  double gain;           ///< above 0, at most 1
};

/// A plate as it is.
struct ServoPlate {
  double wanted;  ///< N
  double felt;    ///< N, that the bodies push back with, dashpots too
  double speed;   ///< m/s, in the last drift
};

/// m², an area times the distances of pairs of planes, where they are.
double plate_area(double area, std::span<const std::array<std::size_t, 2>> between,
                  std::span<const contact::Plane> planes);

/// Whether two pairs of planes bound an area across the direction in which a plate moves: the three
/// do not lie in one plane.
/// @param normal_a, normal_b  unit, of either pair
bool bound_a_plate(const Vec3& normal_a, const Vec3& normal_b, const Vec3& direction) noexcept;

/// @param call  for the message
/// @throws std::invalid_argument for targets that are not finite, below 0, or both 0
void require_target(std::string_view call, double force, double pressure);

/// What a servo wants where its factor is 1, with the planes where they are: N, or N m where it
/// turns a body.
double full_target(const PlaneServo& servo, std::span<const contact::Plane> planes);
double full_target(const BodyServo& servo, std::span<const contact::Plane> planes);

/// Speed (m/s) along the normal, into the bodies, of a plate under servo control: the drift v dt
/// for which
///
///     P(v dt) - P(0) = gain (wanted - felt - c (v - v_last)),  at most largest_speed either way,
///
/// P(s) the elastic force of the bodies, those not yet touched among them, on a plate that is s
/// further in them, c the dashpots of those it touches. Without dashpots the error shrinks by the
/// gain in each step if the bodies stay, and further as they give way, without an error that stays.
/// Seen by the bodies that is a plate without mass, pushed by the wanted force through a dashpot of
/// k dt / gain, k = P': for any gain up to 1 it takes energy away from what swings.
///
/// What is felt has c v_last in it, and will have c v: a plate that followed it as a force would
/// swing from step to step, by gain c / (k dt) of its speed. So v = gain (wanted - felt + c v_last)
/// / (k dt + gain c), as of the plate above with c beside it. A dashpot that would have to pull does
/// nothing: of a plate that goes back no more of it counts than what is felt below P(0).
///
/// Far from the bodies the plate comes on with largest_speed. Where it would touch them, as they are
/// now or will be at the end of the drift, it stops at a thousandth of the elastic force, and presses
/// from there: work is counted by the mean force over a drift, so with a force f that begins in a
/// drift the gap g of before costs energy of 1/2 f g. A plate that struck at full speed would be off
/// by up to 1/8 k (v dt)², v with that of the bodies, whatever that is beside the work of the wanted
/// force. Where they come to it by themselves it waits. Where no force is wanted, a plate without
/// contacts stays.
/// @param press    a force that grows less than in proportion makes the plate slower, never faster.
///                 Dashpots are those of way 0
/// @param dt       s, length of the drift that begins now
double servo_speed(const ServoPace& pace, const ServoPlate& plate, const PressOfWay& press,
                   double dt);

/// What all bodies do to a plane.
struct PlaneReaction {
  Vec3 force = Vec3::Zero();  ///< N
  double push = 0.0;          ///< N, out of their space, wherever it acts

  /// N, of a flat plane against its normal, of a container all around.
  double pressing(const contact::Plane& plane) const noexcept {
    return plane.form == contact::Plane::Form::flat ? 0.0 - force.dot(plane.normal) : push;
  }
};

/// Planes that move by a table or under servo control.
class DrivenPlanes {
 public:
  DrivenPlanes(const Loads& loads, std::span<const contact::Plane> at_start);

  bool empty() const noexcept {
    return motions_.empty() && servos_.empty() && set_velocities_.empty();
  }

  /// By place in Loads::servos, from the next act() on: N and Pa.
  /// @throws std::out_of_range; std::invalid_argument for what require_target() refuses
  void set_target(std::size_t servo, double force, double pressure);
  bool drives(std::size_t plane) const noexcept;
  /// m/s, of a plane that nothing here drives, from the next act() on.
  /// @throws std::invalid_argument for one that is driven, or a velocity that is not finite
  void set_velocity(std::size_t plane, const Vec3& velocity);

  /// Sets the velocities of the drift that begins now. No allocation.
  /// @param reactions  by plane
  /// @returns the work (J) done on the bodies over half of the drift before, as far as the velocity
  ///          there was another one: who counts the whole kick does it with the new velocity
  double act(const LoadStep& step, std::span<const PlaneReaction> reactions,
             const PlanePressAt& press, std::vector<contact::Plane>& planes);

  /// Targets that have been set, and velocities that wait for the next act().
  /// @throws geometry::StateMismatch also where something drove a plane that nothing drives here
  void exchange(const geometry::StateArchive& archive, std::size_t plane_count);

  /// By place in Loads::servos, with targets as they are set.
  const std::vector<PlaneServo>& servos() const noexcept { return servos_; }

  /// m/s, at any of these times.
  double largest_speed(const TimeSpan& during = {}) const noexcept;
  /// m/s, of planes that no load moves.
  double largest_speed_of_others(std::span<const contact::Plane> planes) const noexcept;

 private:
  void require_same_kind(const geometry::StateArchive& archive) const;
  void keep_target(std::size_t servo, double force, double pressure);

  std::vector<PlaneMotion> motions_;
  std::vector<Vec3> start_;  // m, of motions_
  std::vector<PlaneServo> servos_;
  std::vector<std::size_t> set_servos_;
  struct SetVelocity {
    std::size_t plane;
    Vec3 velocity;  // m/s
  };
  std::vector<SetVelocity> set_velocities_;  // till the next act()
};

}  // namespace plekton::dynamics
