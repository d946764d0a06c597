// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/structure/bond_strength.hpp"
#include "dynamics/structure/wire_curve.hpp"

#include <iosfwd>
#include <span>
#include <variant>
#include <vector>

namespace plekton::dynamics {

/// What some bonds of a scene are made of, beyond their stiffness: when they yield and break.
struct BondLaw {
  std::variant<BondStrength, WireCurve> law;
  std::vector<std::size_t> bonds;  ///< by their places in Scene::bonds; each in one law at most
};

/// Writes a line for everything that is wrong with laws: with a strength or a curve, a bond that
/// does not exist or has two laws, a wire that is no bar as stiff as its curve (wire_section).
void list_problems(std::span<const BondLaw> laws, std::span<const BeamBond> bonds,
                   std::ostream& problems);

}  // namespace plekton::dynamics
