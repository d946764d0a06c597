// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "geometry/base/pack.hpp"

#include <cmath>

/// Springs with sliders, whose stiffness may change: the tangential force of a contact, its moments
/// of rolling and twisting. Real is double, or a Pack for contacts side by side.
///
/// A spring that becomes softer gives up force in proportion, one that becomes stiffer keeps its
/// force: in neither case does the energy force^2 / (2 stiffness) grow, so that no cycle of load
/// and slip gains any. Elata & Berryman, Mechanics of Materials 24 (1996) 229-240.
namespace plekton::contact {

/// 1/x, 0 of an x that is 0.
template <class Real>
PLEKTON_INLINE Real inverse_of(const Real& x) noexcept {
  return geometry::select(x > Real(0.0), Real(Real(1.0) / x), Real(0.0));
}

/// Compliance of springs side by side: of one, and of a share of another. 0: there is no spring.
inline double compliance_beside(double compliance, double other, double share) noexcept {
  const double part = std::abs(share);
  if (!(part > 0.0 && other > 0.0)) return compliance;
  return compliance > 0.0 ? 1.0 / (1.0 / compliance + part / other) : other / part;
}

/// The force that a spring would have without its slider.
template <class Real>
struct TrialForceOf {
  geometry::Vec3Of<Real> force;  ///< N (or N m)
  Real magnitude;

  /// @param limit  N (or N m), >= 0, may be infinite
  PLEKTON_INLINE geometry::Vec3Of<Real> limited_to(const Real& limit) const noexcept {
    const Real elastic_part =
        geometry::select(magnitude > limit, Real(limit / magnitude), Real(1.0));
    return elastic_part * force;
  }
};

/// How the stiffness of a spring changes in a step. A spring keeps its compliance from step to
/// step: then a step takes one division, which springs of one contact share. Divisions cost more
/// than all else.
template <class Real>
struct StiffnessChangeOf {
  Real now;                ///< N/m (or N m/rad)
  Real kept;               ///< of the force
  Real compliance_before;  ///< m/N; 0: no contact yet
  Real compliance_now;     ///< m/N; 0 without stiffness

  PLEKTON_INLINE StiffnessChangeOf(const Real& before, const Real& stiffness) noexcept
      : now(stiffness), compliance_before(before) {
    const Real inverse = Real(1.0) / stiffness;
    kept = geometry::select(inverse > before, Real(stiffness * before), Real(1.0));
    compliance_now = geometry::select(stiffness > Real(0.0), inverse, Real(0.0));
  }
  /// Of springs that many times as stiff; without stiffness they give up all of their force.
  /// @param inverse  1/factor; 0 for a factor of 0
  PLEKTON_INLINE StiffnessChangeOf scaled(const Real& factor, const Real& inverse) const noexcept {
    StiffnessChangeOf of_spring = *this;
    of_spring.now = factor * now;
    of_spring.kept = geometry::select(factor > Real(0.0), kept, Real(0.0));
    of_spring.compliance_before = inverse * compliance_before;
    of_spring.compliance_now = inverse * compliance_now;
    return of_spring;
  }

  /// @param force  N (or N m), on body b, tangent to the contact
  /// @param slip   m (or rad), of b relative to a
  PLEKTON_INLINE TrialForceOf<Real> trial(const geometry::Vec3Of<Real>& force,
                                          const geometry::Vec3Of<Real>& slip) const noexcept {
    const geometry::Vec3Of<Real> of_slip = kept * force - now * slip;
    return {of_slip, of_slip.norm()};
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
  force = spring.trial(before, slip).limited_to(limit);
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
  Real compliance = Real(0.0);  ///< m/N, at which the force arose; 0: no contact yet

  /// One step; see advance_spring.
  PLEKTON_INLINE Real advance(const geometry::Vec3Of<Real>& slip, const Real& stiffness,
                              const Real& limit) noexcept {
    const StiffnessChangeOf<Real> change(compliance, stiffness);
    compliance = change.compliance_now;
    return advance_spring(force, slip, change, limit);
  }

  /// J.
  PLEKTON_INLINE Real energy() const noexcept {
    return Real(0.5) * (compliance * force.squaredNorm());
  }

  /// See LawDefaults.
  void scale_history(double factor) noexcept {
    force *= factor;
    compliance /= factor;
  }

  /// Contacts that merge are springs side by side; one that splits leaves each part a share.
  void accumulate_history(const TangentialSpringOf& other, double share) noexcept {
    force += share * other.force;
    compliance = compliance_beside(compliance, other.compliance, share);
  }
};

}  // namespace plekton::contact
