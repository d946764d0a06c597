// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/contact_part.hpp"
#include "contact/law/tangential_spring.hpp"

#include <algorithm>
#include <cmath>
#include <iosfwd>
#include <limits>
#include <type_traits>

namespace plekton::contact {

/// Resistance to rolling and twisting: springs with sliders between the rotations of both bodies.
///
/// Stiffness alpha R_a R_b k_s (N m/rad), with the tangential stiffness k_s of the contact; the
/// moment is limited to eta min(R_a, R_b) times the normal force. Bourrier, Kneib, Chareyre &
/// Fourcaud, Ecological Engineering 61 (2013) 646-657.
struct RollingTwisting : PartDefaults {
  static constexpr std::string_view name = "rolling_twisting";

  struct Properties {
    double rolling_stiffness = 0.0;                                   ///< alpha of rolling, >= 0
    double twisting_stiffness = 0.0;                                  ///< alpha of twisting, >= 0
    double rolling_limit = std::numeric_limits<double>::infinity();   ///< eta of rolling, >= 0
    double twisting_limit = std::numeric_limits<double>::infinity();  ///< eta of twisting, >= 0
  };

  static void list_problems(const Properties& given, std::ostream& out);

  template <class Real>
  struct ParametersOf {
    Real rolling_arms;           ///< m², alpha R_a R_b
    Real twisting_arms;          ///< m²
    Real rolling_arm;            ///< m, eta min(R_a, R_b)
    Real twisting_arm;           ///< m
    Real radius;                 ///< m, the smaller one
    Real inverse_rolling_arms;   ///< 1/m², 0 without them
    Real inverse_twisting_arms;  ///< 1/m²
  };
  using Parameters = ParametersOf<double>;

  template <class Real>
  struct HistoryOf {
    Vec3Of<Real> rolling = Vec3Of<Real>::Zero();  ///< N m, on body b
    Real twisting = Real(0.0);                    ///< N m, on body b, about the normal
    Real compliance = Real(0.0);  ///< m/N, of the contact, at which both arose; 0: no contact yet
  };
  using History = HistoryOf<double>;

  static Parameters combine(const Properties& properties, const Body& a, const Body& b) noexcept {
    const double arms = a.radius * b.radius;
    const double smaller = std::min(a.radius, b.radius);
    const double rolling_arms = properties.rolling_stiffness * arms;
    const double twisting_arms = properties.twisting_stiffness * arms;
    return {rolling_arms,
            twisting_arms,
            properties.rolling_limit * smaller,
            properties.twisting_limit * smaller,
            smaller,
            inverse_of(rolling_arms),
            inverse_of(twisting_arms)};
  }
  /// The stiffness that comes with the contact is multiplied already.
  static Parameters scaled(const Parameters& p, double) noexcept { return p; }

  /// Beside bonds that carry all but a part; infinity times 0 is no number.
  static Parameters unbonded_part(const Parameters& p, double part) noexcept {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    const auto limit = [&](double arm) { return arm < kNone ? part * arm : arm; };
    Parameters beside = p;
    beside.rolling_arm = limit(p.rolling_arm);
    beside.twisting_arm = limit(p.twisting_arm);
    return beside;
  }

  template <class Real>
  PLEKTON_INLINE static ContactForceOf<Real> force(const ParametersOf<Real>& p,
                                                   const RelativeMotionOf<Real>& motion,
                                                   const ContactStiffnessOf<Real>& stiffness,
                                                   HistoryOf<Real>& history, double dt) noexcept {
    const Vec3Of<Real> turned = Real(dt) * motion.spin_velocity;
    const Real twist = turned.dot(motion.normal);
    const Vec3Of<Real> rolled = turned - twist * motion.normal;
    const StiffnessChangeOf<Real> change(history.compliance, stiffness.tangential);
    history.compliance = change.compliance_now;
    const Real of_rolling = advance_spring(history.rolling, rolled,
                                           change.scaled(p.rolling_arms, p.inverse_rolling_arms),
                                           limit(p.rolling_arm, motion));
    const Real of_twisting = advance_spring(history.twisting, twist,
                                            change.scaled(p.twisting_arms, p.inverse_twisting_arms),
                                            limit(p.twisting_arm, motion));
    return {Vec3Of<Real>::Zero(), of_rolling + of_twisting, moment(history, motion.normal)};
  }

  template <class Real>
  PLEKTON_INLINE static Vec3Of<Real> moment(
      const HistoryOf<Real>& history, const std::type_identity_t<Vec3Of<Real>>& normal) noexcept {
    return history.rolling + history.twisting * normal;
  }

  static Vec3 force_of_state(const History&, const Vec3&) noexcept { return Vec3::Zero(); }

  template <class Real>
  PLEKTON_INLINE static Real history_energy(const ParametersOf<Real>& p,
                                            const HistoryOf<Real>& history) noexcept {
    return Real(0.5) * history.compliance *
           (p.inverse_rolling_arms * history.rolling.squaredNorm() +
            p.inverse_twisting_arms * (history.twisting * history.twisting));
  }

  /// Springs between rotations count as one of the slip that has an arm of the smaller radius.
  ///
  /// Around a ball whose contacts have normals n, an axis u meets k_s r² + k_r of each times
  /// 1 - (u n)², and k_t times (u n)². Slip alone meets (k_s r² + k) (1 - (u n)²). The sum of
  /// 1 - (u n)² is at least 2/3 of the number N of contacts about some axis. Where it is S about u,
  /// k = k_t / 2 + max(k_r, k_t) is enough: k S >= k_r S + k_t (N - S) if S >= 2/3 N; else the left
  /// side with 2/3 N is at least the right one at S = 0 and at S = 2/3 N, and so between them.
  template <class Real>
  PLEKTON_INLINE static ContactStiffnessOf<Real> effective(
      const ParametersOf<Real>& p, const ContactStiffnessOf<Real>& stiffness) noexcept {
    const Real arms =
        geometry::larger_of(p.rolling_arms, p.twisting_arms) + Real(0.5) * p.twisting_arms;
    return {stiffness.normal, (Real(1.0) + arms / (p.radius * p.radius)) * stiffness.tangential};
  }

  template <class Real>
  PLEKTON_INLINE static void rotate(HistoryOf<Real>& history,
                                    const FrameRotationOf<Real>& rotation) noexcept {
    history.rolling = rotation(history.rolling);
    history.twisting = rotation.along_normal(history.twisting);
  }
  static void scale_history(History& history, double factor) noexcept {
    history.rolling *= factor;
    history.twisting *= factor;
    history.compliance /= factor;
  }
  static void accumulate_history(History& history, const History& other, double share) noexcept {
    history.rolling += share * other.rolling;
    history.twisting += std::abs(share) * other.twisting;
    history.compliance = compliance_beside(history.compliance, other.compliance, share);
  }

 private:
  /// N m; infinity times 0 is no number.
  template <class Real>
  PLEKTON_INLINE static Real limit(const Real& arm, const RelativeMotionOf<Real>& motion) noexcept {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    return geometry::select(Real(kNone) > arm, Real(arm * motion.elastic_normal_force), arm);
  }
};

static_assert(ContactPart<RollingTwisting>);

}  // namespace plekton::contact
