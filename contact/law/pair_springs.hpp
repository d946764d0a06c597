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

/// What a term of a contact of a sphere with a surface has of the contact.
struct TermPart {
  double elastic = 0.0;  ///< N, elastic force
  double dashpot = 1.0;  ///< part of the contact's dashpot, as if it held the term alone: the parts
                         ///< resist any motion at least as much as the one dashpot does
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
