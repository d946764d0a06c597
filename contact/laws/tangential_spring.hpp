// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/motion.hpp"
#include "geometry/pack.hpp"

#include <cmath>

/// Springs with sliders, whose stiffness may change: the tangential force of a contact, its moments
/// of rolling and twisting. Real is double, or a Pack for contacts side by side.
///
/// A spring that becomes softer gives up force in proportion, one that becomes stiffer keeps its
/// force: in neither case does the energy force^2 / (2 stiffness) grow, so that no cycle of load
/// and slip gains any. Elata & Berryman, Mechanics of Materials 24 (1996) 229-240.
namespace plekton::contact {

/// 1/stiffness, 0 of a stiffness that is 0.
template <class Real>
PLEKTON_INLINE Real compliance_of(const Real& stiffness) noexcept {
  return geometry::select(stiffness > Real(0.0), Real(Real(1.0) / stiffness), Real(0.0));
}

/// How the stiffness of a spring changes in a step. Springs that have it in common share its
/// divisions, which cost more than all else.
template <class Real>
struct StiffnessChangeOf {
  Real now;                ///< N/m (or N m/rad)
  Real kept;               ///< of the force
  Real compliance_before;  ///< m/N; 0: no contact yet
  Real compliance_now;     ///< m/N

  PLEKTON_INLINE StiffnessChangeOf(const Real& before, const Real& after) noexcept
      : now(after), compliance_before(compliance_of(before)), compliance_now(compliance_of(after)) {
    kept = geometry::select(before > after, Real(after * compliance_before), Real(1.0));
  }
  /// Of springs that many times as stiff.
  /// @param inverse  1/factor; 0 for a factor of 0
  PLEKTON_INLINE StiffnessChangeOf scaled(const Real& factor, const Real& inverse) const noexcept {
    StiffnessChangeOf of_spring = *this;
    of_spring.now = factor * now;
    of_spring.compliance_before = inverse * compliance_before;
    of_spring.compliance_now = inverse * compliance_now;
    return of_spring;
  }

  /// Energy (J) that a spring has dissipated in a step: that of the mean force over the step on the
  /// slip, less what the spring has gained; what the leapfrog takes from the kinetic energy.
  /// @param before, after  N (or N m)
  /// @param slip           m (or rad), of b relative to a
  PLEKTON_INLINE Real dissipated(const geometry::Vec3Of<Real>& before,
                                 const geometry::Vec3Of<Real>& after,
                                 const geometry::Vec3Of<Real>& slip) const noexcept {
    const geometry::Vec3Of<Real> twice_mean = before + after;
    return Real(0.5) * (compliance_before * before.squaredNorm() -
                        compliance_now * after.squaredNorm() - twice_mean.dot(slip));
  }
  /// The same along one axis.
  PLEKTON_INLINE Real dissipated(const Real& before, const Real& after,
                                 const Real& slip) const noexcept {
    return Real(0.5) * (compliance_before * (before * before) - compliance_now * (after * after) -
                        (before + after) * slip);
  }
};

/// One step of a spring.
/// @param force  N (or N m), on body b, tangent to the contact
/// @param slip   m (or rad), of b relative to a
/// @param limit  N (or N m), largest force, >= 0, may be infinite
/// @returns the energy (J) dissipated
template <class Real>
PLEKTON_INLINE Real advance_spring(geometry::Vec3Of<Real>& force,
                                   const geometry::Vec3Of<Real>& slip,
                                   const StiffnessChangeOf<Real>& spring,
                                   const Real& limit) noexcept {
  const geometry::Vec3Of<Real> before = force;
  const geometry::Vec3Of<Real> trial = spring.kept * before - spring.now * slip;
  const Real magnitude = trial.norm();
  const Real elastic_part = geometry::select(magnitude > limit, Real(limit / magnitude), Real(1.0));
  force = elastic_part * trial;
  return spring.dissipated(before, force, slip);
}

/// The same of a spring along one axis.
template <class Real>
PLEKTON_INLINE Real advance_spring(Real& force, const Real& slip,
                                   const StiffnessChangeOf<Real>& spring,
                                   const Real& limit) noexcept {
  const Real before = force;
  const Real trial = spring.kept * before - spring.now * slip;
  force = geometry::smaller_of(geometry::larger_of(trial, Real(-limit)), limit);
  return spring.dissipated(before, force, slip);
}

/// The spring of a tangential force.
template <class Real>
struct TangentialSpringOf {
  geometry::Vec3Of<Real> force = geometry::Vec3Of<Real>::Zero();  ///< N, on body b
  Real stiffness = Real(0.0);  ///< N/m, at which the force arose; 0: no contact yet

  /// One step; see advance_spring.
  PLEKTON_INLINE Real advance(const geometry::Vec3Of<Real>& slip, const Real& stiffness_now,
                              const Real& limit) noexcept {
    const StiffnessChangeOf<Real> change(stiffness, stiffness_now);
    stiffness = stiffness_now;
    return advance_spring(force, slip, change, limit);
  }

  /// J.
  PLEKTON_INLINE Real energy() const noexcept {
    return Real(0.5) * (compliance_of(stiffness) * force.squaredNorm());
  }

  /// Contacts that merge are springs side by side; one that splits leaves each part a share.
  void add_share(const TangentialSpringOf& other, double share) noexcept {
    force += share * other.force;
    stiffness += std::abs(share) * other.stiffness;
  }
};

}  // namespace plekton::contact
