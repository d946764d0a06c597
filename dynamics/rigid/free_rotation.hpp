// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"

/// How rigid bodies turn over a drift, in which nothing pushes them.
namespace plekton::dynamics {

/// How a free body turns: the rotation vector (rad, world) from its orientation to the one after a
/// time, for which angular momentum and kinetic energy stay.
///
/// It solves Euler's equations m' = m x w, w = I^-1 m, and p' = p w / 2 for the turn p in the frame
/// of the body, by their Taylor series: all products are of two series, so each coefficient follows
/// from those before it. With |w| h <= 1/8 the terms fall at least like 8^-k (|w'| <= |w|² for any
/// body of mass, whose largest moment is at most the sum of the others), so the series ends at
/// rounding after at most 20 of them; longer times are cut. Unlike the exact solution by elliptic
/// functions (van Zon & Schofield, J. Comput. Phys. 225 (2007) 145) it has no special cases near
/// equal moments and near the separatrix. Between kicks by torques this is the drift of a
/// symplectic splitting (Dullweber, Leimkuhler & McLachlan, J. Chem. Phys. 107 (1997) 5840).
/// @param momentum     kg m²/s, angular, world
/// @param moments      kg m², principal, > 0
/// @param orientation  from the principal axes to the world
/// @param time         s
Vec3 free_turn(const Vec3& momentum, const Vec3& moments, const Quat& orientation,
               double time) noexcept;

/// A rotation of which some axes of the world are held.
struct HeldTurning {
  Vec3 is_free;  ///< 1 about the axes that are free, 0 about the others
  Vec3 spin;     ///< rad/s, about the held axes; 0 about the others
};

/// rad/s, at an orientation: that of the free axes from the components of the angular momentum
/// about them, L_f = (I w)_f.
Vec3 partly_held_spin(const Vec3& momentum, const Vec3& moments, const Quat& orientation,
                      const HeldTurning& held) noexcept;

/// How a body turns that is held about some axes, with the components of its angular momentum about
/// the others constant: as a rotation vector (rad, world). What holds it does no work where it is
/// held at rest, so that the energy stays to the error of the method, a commutator-free one of
/// fourth order (Celledoni, Marthinsen & Owren, Future Gener. Comput. Syst. 19 (2003) 341); exact
/// about a single axis.
/// @param time  s, back where it is negative
Vec3 partly_held_turn(const Vec3& momentum, const Vec3& moments, const Quat& orientation,
                      const HeldTurning& held, double time) noexcept;

}  // namespace plekton::dynamics
