// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/tracking/contact_memory.hpp"

#include <algorithm>

/// The arithmetic of a contact between two spheres, for one pair (Real = double) or for some side
/// by side (Real = Pack).
namespace plekton::contact {

/// Two spheres that touch, or did in the last step.
template <class Real>
struct SpherePairOf {
  Vec3Of<Real> normal;    ///< unit, from a to b
  Real distance;          ///< m, of the centres
  Vec3Of<Real> velocity;  ///< m/s, of centre b relative to centre a
  Vec3Of<Real> spin_a;    ///< rad/s
  Vec3Of<Real> spin_b;    ///< rad/s
  Real radius_a;          ///< m
  Real radius_b;          ///< m

  /// Rate (rad/s) at which both spheres turn about the normal, their mean.
  PLEKTON_INLINE Real twist_rate() const noexcept {
    const Vec3Of<Real> twice_mean = spin_a + spin_b;
    return Real(0.5) * twice_mean.dot(normal);
  }
  /// m, negative when overlapping.
  PLEKTON_INLINE Real gap() const noexcept { return distance - (radius_a + radius_b); }
  /// From each centre to the contact point (m): half way through the overlap.
  PLEKTON_INLINE Real arm_a() const noexcept { return radius_a + Real(0.5) * gap(); }
  PLEKTON_INLINE Real arm_b() const noexcept { return radius_b + Real(0.5) * gap(); }
  /// m/s, of b relative to a at the contact point.
  PLEKTON_INLINE Vec3Of<Real> contact_velocity() const noexcept {
    return velocity - (arm_a() * spin_a + arm_b() * spin_b).cross(normal);
  }
};

/// How two spheres stand and move.
template <class Real>
struct SphereMotionOf {
  Vec3Of<Real> separation;  ///< m, from centre a to centre b
  Vec3Of<Real> velocity;    ///< m/s, of centre b relative to centre a
  Vec3Of<Real> spin_a;      ///< rad/s
  Vec3Of<Real> spin_b;      ///< rad/s
  Real radius_a;            ///< m
  Real radius_b;            ///< m

  /// 1 if the spheres overlap, else 0; without a square root.
  PLEKTON_INLINE Real touch() const noexcept {
    const Real range = radius_a + radius_b;
    return geometry::flag(range * range > separation.squaredNorm());
  }
  /// @param normal    unit, from a to b
  /// @param distance  m, of the centres
  PLEKTON_INLINE SpherePairOf<Real> at(const Vec3Of<Real>& normal,
                                       const Real& distance) const noexcept {
    return {normal, distance, velocity, spin_a, spin_b, radius_a, radius_b};
  }
};

/// How a pair moves in the step (s) that ends its contact.
inline LastDisplacement last_displacement(const SpherePairOf<double>& pair, double dt) noexcept {
  return {dt * pair.contact_velocity(), dt * (pair.spin_b - pair.spin_a)};
}

/// What a step of a pair came to.
template <class Real>
struct SphereStepOf {
  Real gap;                         ///< m
  Vec3Of<Real> force;               ///< N, on b
  Vec3Of<Real> force_cross_normal;  ///< N; times an arm it is the torque on that sphere
  Real arm_a;                       ///< m
  Real arm_b;                       ///< m
  Real dissipated;                  ///< J
  Vec3Of<Real> moment;              ///< N m, on b
};

/// Asks the law.
/// @param history  already turned into the frame of this step
template <class Law, class Real, class Parameters, class History>
PLEKTON_INLINE SphereStepOf<Real> sphere_step(const SpherePairOf<Real>& pair,
                                              const Parameters& parameters, History& history,
                                              double dt) noexcept {
  const Real gap = pair.gap();
  const RelativeMotionOf<Real> motion =
      relative_motion<Real>(pair.normal, gap, Law::elastic_normal_force(parameters, gap),
                            pair.contact_velocity(), pair.spin_b - pair.spin_a);
  const ContactForceOf<Real> answer = Law::force(parameters, motion, history, dt);
  return {gap,          answer.force, answer.force.cross(pair.normal),
          pair.arm_a(), pair.arm_b(), answer.dissipated,
          answer.moment};
}

}  // namespace plekton::contact
