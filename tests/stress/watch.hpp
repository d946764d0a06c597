// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"
#include "dynamics/simulation.hpp"
#include "tests/stress/findings.hpp"

namespace plekton::stress {

/// What is known beforehand of a scene's momentum and energy.
struct Conserved {
  bool momentum = false;          ///< nothing outside acts but even, constant gravity
  bool angular_momentum = false;  ///< nor gravity, and all nodes can turn
  bool energy = false;            ///< nothing outside does work
};

Conserved conserved_in(const apps::Scenario& scenario);

/// Looks at a run from outside, after every step: by positions, velocities and masses alone.
///
/// Sums of the momentum are exact but for rounding: forces between bodies are equal and opposite
/// (momentum), and act along one line or are balanced by moments (angular momentum). Rounding is
/// taken as kRounding of all momentum that was exchanged: forces that cancel each other at a node
/// may be ten thousand times their sum, each rounded by 1e-16, and there are some thousand steps.
class Watch {
 public:
  Watch(const Conserved& conserved, const dynamics::Simulation& simulation);

  void look(const dynamics::Simulation& simulation);
  std::size_t most_contacts() const noexcept { return most_contacts_; }

  /// Also of a run that has become meaningless.
  void find_lost(Findings& findings) const;
  /// At the end of the run.
  void finish(const dynamics::Simulation& simulation, Findings& findings) const;

 private:
  struct Sums {
    geometry::Vec3 momentum = geometry::Vec3::Zero();  ///< N s
    geometry::Vec3 angular = geometry::Vec3::Zero();   ///< N m s, about the origin
    double kinetic = 0.0;                              ///< J
    double height = 0.0;                               ///< J, m g.x
    double magnitude = 0.0;                            ///< N s, sum of m |v|
    double angular_magnitude = 0.0;                    ///< N m s
  };
  static Sums sums_of(const dynamics::Simulation& simulation);

  static constexpr double kRounding = 1e-9;

  Conserved conserved_;
  Sums first_;
  std::vector<geometry::Vec3> velocity_;  ///< m/s, after the last step
  std::vector<geometry::Vec3> spin_;
  double mass_ = 0.0;              ///< kg
  double time_ = 0.0;              ///< s, after the last step
  double drift_ = 0.0;             ///< s, of the last step
  double exchanged_ = 0.0;         ///< N s, sum of m |change of v|
  double turned_ = 0.0;            ///< N m s, likewise
  std::size_t most_contacts_ = 0;  ///< at a time
  std::int64_t lost_step_ = -1;    ///< at which something was no number
};

}  // namespace plekton::stress
