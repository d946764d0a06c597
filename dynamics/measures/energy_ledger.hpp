// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/integrators/leapfrog.hpp"
#include "dynamics/loads/load_step.hpp"
#include "dynamics/measures/energy.hpp"

#include <cmath>
#include <string>
#include <utility>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::dynamics {

/// What a simulation remembers of its energy: what is neither in its bodies nor told by them.
///
/// All in J. A kick is longer than up to the moment of the forces that it is made with: what it does
/// after that moment is pending, and counts from the next one on.
class EnergyLedger {
 public:
  /// @param kinetic  at the start
  /// @param initial  that, with all elastic energy
  void start(double kinetic, double initial) noexcept;

  /// Books a step.
  /// @param work      of its kick
  /// @param left      what loads do in the half of the drift that begins now
  /// @param is_first  whether the kick is the first one: it has the kinetic energy of the start
  void book(const StepWork& work, const StepLengths& lengths, const LoadWork& left,
            bool is_first) noexcept;

  void add_external(double work) noexcept { work_.external += work; }
  void add_damped(double taken) noexcept { work_.damped += taken; }
  /// Kinetic energy that comes from outside at once.
  void bring_kinetic(double kinetic) noexcept {
    work_.kinetic += kinetic;
    work_.external += kinetic;
  }
  /// Work from outside, some of which counts from the next step on.
  void bring(double from_outside, double pending) noexcept {
    work_.external += from_outside;
    pending_.external += pending;
  }
  /// Of bonds that broke because they were asked to.
  void add_broken(double lost) noexcept { broken_ += lost; }
  /// What contacts had stored on what was taken out.
  void add_taken_out(double stored) noexcept { taken_out_ += stored; }

  /// Without what bodies and contacts tell by themselves: what they lost is to be added.
  Energy energy() const noexcept;

  /// Whether the kinetic energy is twice what it was at any look.
  bool has_doubled() const noexcept { return !(std::abs(work_.kinetic) <= 2.0 * most_kinetic_); }
  /// Looks at the energy of now.
  /// @returns what there was at most so far that did not come from nowhere
  double look(const Energy& now) noexcept;
  /// What acted where energy came from nowhere, at the last of such looks.
  const std::string& suspect() const noexcept { return suspect_; }
  void set_suspect(std::string suspect) { suspect_ = std::move(suspect); }

  void exchange(const geometry::StateArchive& archive);

 private:
  StepWork work_;     ///< kinetic: of the last step; the rest: of all steps
  StepWork pending_;  ///< what of damped and external comes after the moment of the last forces
  double broken_ = 0.0;
  double taken_out_ = 0.0;
  double initial_ = 0.0;
  double most_kinetic_ = 0.0;    ///< at the looks
  double most_accounted_ = 0.0;  ///< largest turnover at those without what came from nowhere
  std::string suspect_;
};

}  // namespace plekton::dynamics
