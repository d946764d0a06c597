// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/structure/normal_spring.hpp"
#include "contact/structure/simplex.hpp"

#include <span>

/// What a chain of bars keeps of its contacts where it wraps around a body.
///
/// Bars in range count as one contact each, less one at every joint in range (nearest.hpp and the
/// weights of product_features.hpp): what hangs together is one contact. That is right where a
/// chain passes straight by or bends away from the other body. Where it bends around it, every bar
/// has a nearest point of its own, and forty bars that merge must not count as one.
///
/// The rule that does not depend on where a chain is cut is additive: a bar counts at a level s
/// (the part of it nearer than s to the nearest point of the other body) by the angle of the half
/// circle of the radius s over its chord, over pi. Beside the joints that is the above; at a joint
/// with the arms e_i (unit) and the separation r, of length d, from the other body to the joint it
/// is more by
///
///     x(s) = sum of atan(y_i / t) / pi,    y_i = -r . e_i,    t^2 = s^2 - d^2,
///
/// y_i being how far along its arm the foot is. For two arms the sign of x is that of y_1 + y_2 at
/// all levels: negative where they bend away (the other body sees a knee), 0 where they are
/// straight, positive in a wrap, where it falls from 1, what the joint has taken, to 0. A wrap gets
/// it back:
///
///     W = integral of f(x(s)) (-phi'(s)) ds    from d to the range,
///
/// with f(x) = x but for x below a few kBend, where f(x) = x^3 / (x^2 + kBend^2) lets the force go
/// to 0 with the angle, and f(x) = 0 of x < 0. Half of a drum with 20 to 160 bars has the same
/// force within 17 % from 1.6 sagittas of the longest bars on, with any kBend from 0.0025 to 0.01.
///
/// W is a function of the arms and of r alone, as the energy of the joint is of d. So what the
/// features of the other body do adds up with the same weights: a drum of one cylinder, of a chain
/// or of facets is the same. Its gradient changes continuously wherever r does so smoothly; where
/// the nearest point passes over an edge of facets the part of the force along the surface jumps,
/// by what the arms do not balance: nothing where they are in line with each other.
namespace plekton::contact::structure {

/// Of the angle, see above.
constexpr double kBend = 0.005;

/// More bars than that at a joint get nothing back.
constexpr std::size_t kMostArms = 16;

/// W of one joint, and its derivatives (N).
struct WrapEnergy {
  double energy = 0.0;  ///< J
  Vec3 by_separation = Vec3::Zero();
};
/// @param separation  m, to the joint from the nearest point of the other body
/// @param arms        m, from the joint to the other ends of its bars; two or more, kMostArms at
/// most
/// @param by_arms     gets the derivatives by the arms
WrapEnergy wrap_energy(const Vec3& separation, std::span<const Vec3> arms,
                       const NormalSpring& spring, std::span<Vec3> by_arms);

/// Where a separation leads to: a point of a simplex.
struct Foot {
  unsigned corners;  ///< that span the lowest feature that holds it
  Vec3 weights;
  Vec3 separation;  ///< m, from it to the joint; perpendicular to that feature
};

/// Forces of an energy that depends on the separation of a joint from its nearest point.
/// @param on_other  gets those on the corners of the simplex
/// @returns the force on the joint
Vec3 separating_forces(const Vec3& by_separation, const Simplex& other, const Foot& foot,
                       std::array<Vec3, 3>& on_other);

}  // namespace plekton::contact::structure
