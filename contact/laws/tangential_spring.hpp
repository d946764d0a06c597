// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/motion.hpp"

#include <cmath>

namespace plekton::contact {

/// A spring with a slider, whose stiffness may change: the tangential force of a contact, or its
/// moment of rolling.
///
/// A spring that becomes softer gives up force in proportion, one that becomes stiffer keeps its
/// force: in neither case does the energy force^2 / (2 stiffness) grow, so that no cycle of load
/// and slip gains any. Elata & Berryman, Mechanics of Materials 24 (1996) 229-240.
struct TangentialSpring {
  Vec3 force = Vec3::Zero();  ///< N (or N m), on body b, tangent to the contact
  double stiffness = 0.0;     ///< N/m (or N m/rad), at which the force arose; 0: no contact yet

  /// One step.
  /// @param slip   m (or rad), of b relative to a
  /// @param limit  N (or N m), largest force, >= 0
  /// @returns the energy (J) dissipated: that of the mean force over the step on the slip, less
  /// what the spring has gained; what the leapfrog takes from the kinetic energy
  double advance(const Vec3& slip, double stiffness_now, double limit) noexcept {
    const double energy_before = energy();
    const Vec3 before = force;
    if (stiffness_now < stiffness) force *= stiffness_now / stiffness;
    stiffness = stiffness_now;
    force -= stiffness * slip;
    const double magnitude = force.norm();
    if (magnitude > limit) force *= limit / magnitude;
    return energy_before - energy() - 0.5 * (before + force).dot(slip);
  }

  /// J.
  double energy() const noexcept {
    return stiffness > 0.0 ? 0.5 * force.squaredNorm() / stiffness : 0.0;
  }

  /// Contacts that merge are springs side by side; one that splits leaves each part a share.
  void add_share(const TangentialSpring& other, double share) noexcept {
    force += share * other.force;
    stiffness += std::abs(share) * other.stiffness;
  }
};

}  // namespace plekton::contact
