// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace plekton::contact {

/// Energy (J) that contacts no longer store after a step.
struct EnergyLoss {
  double dissipated = 0.0;  ///< by the law, and with contacts that are over
  /// Lost where histories were handed from the contacts of the last step to those of this one;
  /// below 0: made.
  double tracking = 0.0;

  EnergyLoss& operator+=(const EnergyLoss& other) noexcept {
    dissipated += other.dissipated;
    tracking += other.tracking;
    return *this;
  }
};

}  // namespace plekton::contact
