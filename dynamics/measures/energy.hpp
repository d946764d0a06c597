// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace plekton::dynamics {

/// Where the energy of a simulation is, and where it went. All in J, at the moment of the last
/// forces.
struct Energy {
  double kinetic = 0.0;  ///< of all motions that are free
  double contact_elastic = 0.0;
  double bond_elastic = 0.0;  ///< with that of ties
  double sheet_elastic = 0.0;
  double gravity = 0.0;          ///< of the nodes that are free, from their places at the start
  double friction = 0.0;         ///< dissipated in contacts
  double tracking = 0.0;         ///< lost, or below 0 made, where contacts go on as others: handed
                                 ///< from patch to patch, and with elements that break
  double bond_dissipated = 0.0;  ///< by bonds that yielded or broke, sheets that tore, ties
                                 ///< that slid, paid out or broke
  double damping = 0.0;          ///< taken by numerical damping
  double external_work = 0.0;    ///< done on the bodies by what moves as prescribed and by loads
  double initial = 0.0;          ///< kinetic + elastic at the start; kinetic as the leapfrog has
                                 ///< it, below the true one by 1/2 m (a dt / 2)²
  double rounding = 0.0;         ///< what rounding alone may add up to in closure_error()

  /// What is not accounted for: 0 but for the error of the time integration.
  double closure_error() const noexcept {
    return kinetic + contact_elastic + bond_elastic + sheet_elastic + gravity + friction +
           tracking + bond_dissipated + damping - external_work - initial;
  }
  /// What has come from nowhere: not accounted for, or made by tracking or by contact laws.
  double made() const noexcept { return closure_error() + made_in_contacts(); }
  /// What there is in bodies, or was, and has not come from nowhere. Kinetic energy as the leapfrog
  /// has it is negative where velocities turn over within a step, and then balances elastic energy
  /// that the step makes.
  double accounted() const noexcept {
    return turnover() - 2.0 * std::max(0.0, -kinetic) - made_in_contacts() - std::max(0.0, made());
  }
  /// What went through: all that is or was something else than energy of position, in magnitude.
  /// What bodies give up to an attraction is negative while they touch, and energy that a step too
  /// long or a law makes shows as negative dissipation: taken off, they would hide an error.
  double turnover() const noexcept {
    return std::abs(kinetic) + std::abs(contact_elastic) + std::abs(bond_elastic) +
           std::abs(sheet_elastic) + std::abs(friction) + std::abs(tracking) +
           std::abs(bond_dissipated) + std::abs(damping);
  }
  /// Magnitude of the closure error over turnover, >= 0; 0 where the error is no more than
  /// rounding, as when nothing has happened.
  double closure() const noexcept { return closure(turnover()); }
  /// The same over what went through at another moment. A ball at its highest point has little else
  /// than energy of position: over time an error is measured against the largest turnover so far.
  /// @param turnover  J, > 0 if anything has happened
  double closure(double turnover) const noexcept {
    const double error = std::abs(closure_error());
    return error > rounding ? error / turnover : 0.0;
  }

 private:
  double made_in_contacts() const noexcept {
    return std::max(0.0, -tracking) + std::max(0.0, -friction);
  }
};

}  // namespace plekton::dynamics
