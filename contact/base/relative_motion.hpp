// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "geometry/base/pack.hpp"

#include <type_traits>

namespace plekton::contact {

using geometry::Vec3Of;

/// All that a contact law may know: how body b moves relative to body a at their contact point.
/// Real is double, or a Pack for contacts side by side.
template <class Real>
struct RelativeMotionOf {
  Vec3Of<Real> normal;         ///< unit, from a to b
  Vec3Of<Real> slip_velocity;  ///< m/s, of b relative to a, in the contact plane
  Real gap;                    ///< m, of the deepest feature; negative when overlapping
  Real gap_rate;               ///< m/s, positive when separating
  Real
      elastic_normal_force;  ///< N, >= 0: the law's own elastic normal force, summed over the patch
  /// rad/s, of b relative to a: for laws with moments.
  Vec3Of<Real> spin_velocity = Vec3Of<Real>::Zero();
};
using RelativeMotion = RelativeMotionOf<double>;

/// What a law answers.
template <class Real>
struct ContactForceOf {
  Vec3Of<Real> force;  ///< N, on body b; the elastic normal force included
  Real dissipated;     ///< J, during this step, by friction or viscosity
  /// N m, on body b; a gets the opposite. Zero but for laws that say moment().
  Vec3Of<Real> moment = Vec3Of<Real>::Zero();
};
using ContactForce = ContactForceOf<double>;

/// Splits the velocity of b relative to a into gap rate and slip.
template <class Real = double>
PLEKTON_INLINE RelativeMotionOf<Real> relative_motion(
    const Vec3Of<Real>& normal, const std::type_identity_t<Real>& gap,
    const std::type_identity_t<Real>& elastic_normal_force, const Vec3Of<Real>& relative_velocity,
    const Vec3Of<Real>& spin_velocity = Vec3Of<Real>::Zero()) noexcept {
  const Real gap_rate = relative_velocity.dot(normal);
  return {normal,       relative_velocity - gap_rate * normal, gap, gap_rate, elastic_normal_force,
          spin_velocity};
}

}  // namespace plekton::contact
