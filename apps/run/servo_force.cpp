// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/servo_force.hpp"

#include "dynamics/loads/plane_servo.hpp"
#include "dynamics/loads/rigid_servo.hpp"
#include "geometry/base/state_archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace plekton::apps {
namespace {

/// @param factor_of  (factor) -> the number by which the full target is multiplied
template <class FactorOf>
ServoForce force_of(const dynamics::BodyServo& servo, const dynamics::Simulation& simulation,
                    const FactorOf& factor_of) {
  const Vec3 direction = dynamics::DrivenBodies::direction_of(servo);
  const Vec3& felt = servo.turns() ? simulation.gathered_torque(servo.body)
                                   : simulation.gathered_force(servo.body);
  return {0.0 - felt.dot(direction),
          factor_of(servo.factor) * dynamics::full_target(servo, simulation.planes()),
          servo.turns() ? "N m" : "N"};
}

template <class FactorOf>
ServoForce force_of(const dynamics::PlaneServo& servo, const dynamics::Simulation& simulation,
                    const FactorOf& factor_of) {
  return {simulation.pressing_on(servo.plane),
          factor_of(servo.factor) * dynamics::full_target(servo, simulation.planes()), "N"};
}

}  // namespace

bool ServoForce::is_within(double tolerance) const noexcept {
  return std::abs(felt - wanted) <= tolerance * std::abs(wanted);
}

std::string ServoForce::text() const {
  return fmt::format("feels {:.4g} {} and wants {:.4g} {}", felt, unit, wanted, unit);
}

ServoForce servo_force(const ServoEnd& end, const dynamics::Simulation& simulation) {
  const auto at_end = [](const dynamics::TimeTable& factor) { return factor.rows().back().value; };
  const dynamics::Loads& loads = simulation.scene().loads;
  if (end.body_servo) return force_of(loads.body_servos[*end.body_servo], simulation, at_end);
  const auto servo = std::ranges::find_if(
      loads.servos, [&](const dynamics::PlaneServo& one) { return one.plane == end.plane; });
  return force_of(*servo, simulation, at_end);
}

ServoWatch::ServoWatch(const Scenario& scenario) {
  std::size_t planes = 0, bodies = 0;
  for (const LoadSettings& load : scenario.loads) {
    if (std::holds_alternative<dynamics::PlaneServo>(load.load))
      servos_.push_back({load.name, planes++, false});
    if (std::holds_alternative<BodyServoSettings>(load.load))
      servos_.push_back({load.name, bodies++, true});
  }
  has_reached_.resize(servos_.size());
  has_wanted_.resize(servos_.size());
}

ServoForce ServoWatch::force_now(const Servo& servo, const dynamics::Simulation& simulation) const {
  const auto now = [&](const dynamics::TimeTable& factor) { return factor.at(simulation.time()); };
  const dynamics::Loads& loads = simulation.scene().loads;
  return servo.drives_body ? force_of(loads.body_servos[servo.number], simulation, now)
                           : force_of(loads.servos[servo.number], simulation, now);
}

void ServoWatch::look(const dynamics::Simulation& simulation) {
  constexpr double kTolerance = 0.02;
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    if (has_reached_[i] != 0) continue;
    const ServoForce force = force_now(servos_[i], simulation);
    if (!(force.wanted > 0.0)) continue;
    has_wanted_[i] = 1;
    has_reached_[i] = force.is_within(kTolerance) ? 1 : 0;
  }
}

std::vector<std::string> ServoWatch::warnings(const dynamics::Simulation& simulation) const {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    if (has_reached_[i] != 0 || has_wanted_[i] == 0) continue;
    warnings.push_back(fmt::format(
        "servo \"{}\" never came to bear what it wanted: at the end it {}; give it more time or "
        "speed, or a target that what it presses on can bear",
        servos_[i].load, force_now(servos_[i], simulation).text()));
  }
  return warnings;
}

void ServoWatch::exchange(const geometry::StateArchive& archive) {
  archive.fixed("has_reached", has_reached_, "servos");
  archive.fixed("has_wanted", has_wanted_, "servos");
}

}  // namespace plekton::apps
