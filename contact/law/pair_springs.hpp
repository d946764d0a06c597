// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/any_law.hpp"

namespace plekton::contact {

/// What a contact resists motion with, for a time step.
struct PairStiffness {
  double normal = 0.0;          ///< N/m
  double tangential = 0.0;      ///< N/m
  double normal_damping = 0.0;  ///< N s/m

  friend PairStiffness operator*(double part, const PairStiffness& whole) noexcept {
    return {part * whole.normal, part * whole.tangential, part * whole.normal_damping};
  }
};

/// The springs of one contact of a pair of bodies by the gap (m, negative when overlapping). Refers
/// to the parameters of the pair, which must live as long.
class PairSprings {
 public:
  PairSprings(const AnyLaw::Parameters& parameters) noexcept  // NOLINT: its springs are what it is
      : parameters_(parameters) {}

  /// N, elastic; 0 for a gap >= 0.
  double normal_force(double gap) const { return AnyLaw::elastic_normal_force(parameters_, gap); }
  PairStiffness stiffness(double gap) const {
    return {AnyLaw::normal_stiffness(parameters_, gap),
            AnyLaw::tangential_stiffness(parameters_, gap),
            AnyLaw::normal_damping(parameters_, gap)};
  }

 private:
  const AnyLaw::Parameters& parameters_;
};

}  // namespace plekton::contact
