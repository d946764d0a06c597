// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/structure/bond_forces.hpp"
#include "dynamics/structure/bond_strength.hpp"
#include "dynamics/structure/wire_curve.hpp"

/// How one bond yields: what it keeps of that is where it is at rest, so that the elastic bond
/// gives the forces (beam_kernel.hpp), in any configuration, without drift.
namespace plekton::dynamics {

/// What a beam remembers of its yielding.
struct BeamYield {
  double stretch = 0.0;     ///< m, all plastic stretch so far, in either direction
  double turn_a = 0.0;      ///< rad, all plastic turning of the end at node a against the chord
  double turn_b = 0.0;      ///< rad
  double twist = 0.0;       ///< rad
  BondForces forces;        ///< when it was last looked at, moments in the frames of their nodes
  double loss = 0.0;        ///< J, by the last look
  double dissipated = 0.0;  ///< J, by all of them
};

/// Moves the state at rest of a beam to where it keeps its limits.
///
/// With k the axial stiffness, c = EI/L0 and t = GJ/L0, plastic stretch s, turns p_a and p_b of the
/// ends and twist w lower the forces to N - k s, M_a - 4 c p_a - 2 c p_b, M_b - 2 c p_a - 4 c p_b,
/// T - t w. Each flows along its force (closest point on the limits in the norm of the energy), and
/// as far as brings that back to the limit, which grows by the hardening. For large rotations these
/// stiffnesses are not quite those of the bond: repeated with the forces of the bond itself, until
/// these are at their limits to rounding.
///
/// The loss is half the sum of the forces before and after, times the plastic change: together with
/// the leapfrog that balances to rounding as long as the bond is linear.
/// @returns whether it yields, so that spring has changed
bool yield(const BeamEndsOf<double>& ends, const BondLimits& limits, BeamSpringOf<double>& spring,
           BeamYield& memory) noexcept;

/// Whether a beam breaks under the forces, or by the plastic strain, that it remembers.
bool is_broken(const BondLimits& limits, const BeamYield& memory) noexcept;

/// What a wire remembers.
struct WireYield {
  double rest_length;       ///< m, below which it is slack
  double force = 0.0;       ///< N, when it was last looked at; 0 if it is slack or broken
  double dissipated = 0.0;  ///< J, by all looks
};

/// Moves the state at rest of a wire to where its force is that of its curve: to where its ends are
/// if it is slack.
///
/// The loss is half the sum of the forces before and after, times the plastic change; one that
/// breaks yields to no force. With what is stored that is the work of the leapfrog, to rounding,
/// but where the wire becomes taut or slack within a step: there it is off by k times the taut and
/// the slack part of the way over two (ContactSprings::ending_step()).
/// @param length  m, between its ends now
/// @param at_first  m, L0
/// @returns whether it breaks
bool yield(double length, double at_first, const WireCurve& curve, BeamSpringOf<double>& spring,
           WireYield& memory) noexcept;

}  // namespace plekton::dynamics
