// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/energy_ledger.hpp"

#include "geometry/base/state_archive.hpp"

#include <algorithm>

namespace plekton::dynamics {

void EnergyLedger::start(double kinetic, double initial) noexcept {
  work_.kinetic = kinetic;
  most_kinetic_ = kinetic;
  initial_ = initial;
}

void EnergyLedger::book(const StepWork& work, const StepLengths& lengths, const LoadWork& left,
                        bool is_first) noexcept {
  // The part of the kick that comes after the moment of the forces: all of the first one, half of
  // one between drifts of equal lengths.
  const double later = 0.5 * lengths.drift / lengths.kick;
  pending_ = {0.0, later * work.damped + left.damped, later * work.external + left.external};
  if (is_first) initial_ += work.kinetic - work_.kinetic;
  work_.kinetic = work.kinetic;
  work_.damped += work.damped + left.damped;
  work_.external += work.external + left.external;
}

Energy EnergyLedger::energy() const noexcept {
  Energy energy;
  energy.kinetic = work_.kinetic;
  energy.tracking = -taken_out_;
  energy.bond_dissipated = broken_;
  energy.damping = work_.damped - pending_.damped;
  energy.external_work = work_.external - pending_.external;
  energy.initial = initial_;
  return energy;
}

double EnergyLedger::look(const Energy& now) noexcept {
  most_kinetic_ = std::max(most_kinetic_, std::abs(now.kinetic));
  most_accounted_ = std::max(most_accounted_, now.accounted());
  return most_accounted_;
}

void EnergyLedger::exchange(const geometry::StateArchive& archive) {
  const auto exchange_work = [&](const char* name, StepWork& work) {
    const geometry::StateArchive of = archive.group(name);
    of("kinetic", work.kinetic);
    of("damped", work.damped);
    of("external", work.external);
    of("fastest_squared", work.fastest_squared);
    of("fastest_spin_squared", work.fastest_spin_squared);
  };
  exchange_work("work", work_);
  exchange_work("pending", pending_);
  archive("broken", broken_);
  archive("taken_out", taken_out_);
  archive("initial", initial_);
  archive("most_kinetic", most_kinetic_);
  archive("most_accounted", most_accounted_);
  archive("suspect", suspect_);
}

}  // namespace plekton::dynamics
