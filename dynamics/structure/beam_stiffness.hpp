// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/stiffness/nodal_stiffness.hpp"
#include "dynamics/structure/beam_bond.hpp"

namespace plekton::dynamics {

/// Adds a bond as long as it is now, its nodes turned little from the chord (less than 45
/// degrees). Tension is included: it resists turning of the chord. So a bond may shorten its step
/// as it stretches. A bond of length 0 counts as long as at rest.
///
/// Let gamma = 4 rho² / L², rho² = 2/5 A / pi the square of a node's radius of gyration: the
/// scale at which translation and rotation limit an unloaded beam alike. For equal beams in a
/// chain this gives omega² <= (E / density) / L² (7.5 + 12 A / (pi L²)), which is what Fried's
/// theorem gives for single elements, exact for slender ones.
/// @param rest_length  m, where its tension begins: the bond's length, or what yielding made it
void add_beam(NodalStiffness& stiffness, const BeamBond& bond, const NodeState& state,
              double rest_length);
inline void add_beam(NodalStiffness& stiffness, const BeamBond& bond, const NodeState& state) {
  add_beam(stiffness, bond, state, bond.length);
}

}  // namespace plekton::dynamics
