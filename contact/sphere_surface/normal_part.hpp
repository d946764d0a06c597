// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/any_law.hpp"

#include <algorithm>

namespace plekton::contact {

/// What one contact of a sphere with a surface pushes and pulls along its normal, by the gap (m,
/// negative when overlapping). Both count by the terms of a patch, so that its energy is one
/// function of the places for an attraction too. Refers to the parameters, which must live as long.
class NormalPart {
 public:
  /// @param parameters  without the attraction
  /// @param attraction  N, of bodies that touch, see LawDefaults
  NormalPart(const AnyLaw::Parameters& parameters, double attraction) noexcept
      : parameters_(parameters), attraction_(attraction) {}

  /// N.
  double elastic_force(double gap) const { return AnyLaw::elastic_normal_force(parameters_, gap); }
  /// N, against the normal.
  double attraction(double gap) const { return gap < 0.0 ? attraction_ : 0.0; }

  /// N and J, of both.
  double force(double gap) const { return elastic_force(gap) - attraction(gap); }
  double energy(double gap) const {
    return AnyLaw::elastic_normal_energy(parameters_, gap) + attraction_ * std::min(gap, 0.0);
  }

 private:
  const AnyLaw::Parameters& parameters_;
  double attraction_;
};

}  // namespace plekton::contact
