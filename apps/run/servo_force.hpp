// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"
#include "dynamics/simulation.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::apps {

/// What a servo bears, and what it wants.
struct ServoForce {
  double felt = 0.0;            ///< N along its direction, or N m about it
  double wanted = 0.0;          ///< the same
  std::string_view unit = "N";  ///< of both

  bool is_within(double tolerance) const noexcept;
  /// As in "feels 1 N and wants 90 N".
  std::string text() const;
};

/// That of the servo which ends a stage or a run, at the end of its factor.
ServoForce servo_force(const ServoEnd& end, const dynamics::Simulation& simulation);

/// Notes of the servos of a scenario whether they ever came to bear what they wanted at that time.
class ServoWatch {
 public:
  explicit ServoWatch(const Scenario& scenario);

  /// To be called now and then, after steps.
  void look(const dynamics::Simulation& simulation);

  /// A warning for each that never did, within 2 % of what it wanted, above 0.
  std::vector<std::string> warnings(const dynamics::Simulation& simulation) const;

  void exchange(const geometry::StateArchive& archive);

 private:
  struct Servo {
    std::string load;  ///< its name
    std::size_t number = 0;
    bool drives_body = false;
  };
  ServoForce force_now(const Servo& servo, const dynamics::Simulation& simulation) const;

  std::vector<Servo> servos_;
  std::vector<std::uint8_t> has_reached_;  ///< by servo
  std::vector<std::uint8_t> has_wanted_;   ///< by servo, more than 0
};

}  // namespace plekton::apps
