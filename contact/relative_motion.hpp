// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/motion.hpp"

namespace plekton::contact {

/// All that a contact law may know: how body b moves relative to body a at their contact point.
struct RelativeMotion {
  Vec3 normal;                  ///< unit, from a to b
  Vec3 slip_velocity;           ///< m/s, of b relative to a, in the contact plane
  double gap;                   ///< m, of the deepest feature; negative when overlapping
  double gap_rate;              ///< m/s, positive when separating
  double elastic_normal_force;  ///< N, >= 0: the law's own elastic normal force, summed over the patch
};

/// What a law answers.
struct ContactForce {
  Vec3 force;         ///< N, on body b; the elastic normal force included
  double dissipated;  ///< J, during this step, by friction or viscosity
};

/// Splits the velocity of b relative to a into gap rate and slip.
inline RelativeMotion relative_motion(const Vec3& normal, double gap, double elastic_normal_force,
                                      const Vec3& relative_velocity) noexcept {
  const double gap_rate = relative_velocity.dot(normal);
  return {normal, relative_velocity - gap_rate * normal, gap, gap_rate, elastic_normal_force};
}

}  // namespace plekton::contact
