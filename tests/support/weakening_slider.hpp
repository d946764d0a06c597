// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/contact_law.hpp"

#include <algorithm>
#include <type_traits>

namespace plekton::test {

/// A law that only tests know, written as a new one would be: nothing but this file and its row in
/// a list of laws.
///
/// Normal force k o + h o^2 of the overlap o. Tangential force k_s * elastic slip, limited to the
/// normal force times tan(phi) L / (L + s), where s is the way slid so far: surfaces that polish
/// each other. The history are four numbers, unlike that of LinearFrictional.
struct WeakeningSlider : contact::LawDefaults {
  static constexpr std::string_view name = "weakening_slider";

  template <class Real>
  struct ParametersOf {
    Real normal_stiffness;      ///< N/m, of the first touch
    Real stiffening;            ///< N/m^2
    Real tangential_stiffness;  ///< N/m
    Real friction;              ///< tan(phi), before anything has slid
    Real polishing_way;         ///< m, after which half of the friction is left
  };
  using Parameters = ParametersOf<double>;

  template <class Real>
  struct HistoryOf {
    contact::Vec3Of<Real> elastic_slip =
        contact::Vec3Of<Real>::Zero();  ///< m, of b relative to a, tangent to the contact
    Real way_slid = Real(0.0);          ///< m
  };
  using History = HistoryOf<double>;

  static Parameters combine(const contact::Body& a, const contact::Body& b) noexcept {
    const contact::Material &m = a.material, &n = b.material;
    const double smaller = std::min(a.radius, b.radius);
    const double stiffness = std::min(m.young_modulus, n.young_modulus) * smaller;
    return {stiffness, stiffness / smaller,
            std::min(m.stiffness_ratio, n.stiffness_ratio) * stiffness,
            std::min(m.friction, n.friction), 0.01 * smaller};
  }

  static Parameters scaled(const Parameters& p, double count) noexcept {
    return {count * p.normal_stiffness, count * p.stiffening, count * p.tangential_stiffness,
            p.friction, p.polishing_way};
  }

  template <class Real>
  PLEKTON_INLINE static Real elastic_normal_force(const ParametersOf<Real>& p,
                                                  const std::type_identity_t<Real>& gap) noexcept {
    const Real overlap = geometry::positive_part(Real(-gap));
    return (p.normal_stiffness + p.stiffening * overlap) * overlap;
  }

  static double elastic_normal_energy(const Parameters& p, double gap) noexcept {
    const double overlap = std::max(0.0, -gap);
    return (p.normal_stiffness / 2.0 + p.stiffening * overlap / 3.0) * overlap * overlap;
  }

  template <class Real>
  PLEKTON_INLINE static contact::ContactForceOf<Real> force(
      const ParametersOf<Real>& p, const contact::RelativeMotionOf<Real>& motion,
      HistoryOf<Real>& history, double dt) noexcept {
    using Vector = contact::Vec3Of<Real>;
    const Vector before = history.elastic_slip;
    const Vector trial = before + Real(dt) * motion.slip_velocity;
    const Real friction = p.friction * (p.polishing_way / (p.polishing_way + history.way_slid));
    const Real limit = friction * motion.elastic_normal_force;
    const Real trial_force = p.tangential_stiffness * trial.norm();
    const Real elastic_part =
        geometry::select(trial_force > limit, Real(limit / trial_force), Real(1.0));
    history.elastic_slip = elastic_part * trial;
    const Vector slid = trial - history.elastic_slip;
    history.way_slid = history.way_slid + slid.norm();
    const Vector twice_mean_slip = before + history.elastic_slip;
    return {
        motion.elastic_normal_force * motion.normal - p.tangential_stiffness * history.elastic_slip,
        Real(0.5) * p.tangential_stiffness * twice_mean_slip.dot(slid)};
  }

  template <class Real>
  PLEKTON_INLINE static Real history_energy(const ParametersOf<Real>& p,
                                            const HistoryOf<Real>& history) noexcept {
    return Real(0.5) * p.tangential_stiffness * history.elastic_slip.squaredNorm();
  }

  static double normal_stiffness(const Parameters& p, double gap) noexcept {
    return p.normal_stiffness + 2.0 * p.stiffening * std::max(0.0, -gap);
  }
  static double tangential_stiffness(const Parameters& p, double) noexcept {
    return p.tangential_stiffness;
  }

  template <class Real>
  PLEKTON_INLINE static void rotate(HistoryOf<Real>& history,
                                    const contact::FrameRotationOf<Real>& rotation) noexcept {
    history.elastic_slip = rotation(history.elastic_slip);
  }

  static void accumulate_history(History& history, const History& other, double share) noexcept {
    history.elastic_slip += share * other.elastic_slip;
    history.way_slid += share * other.way_slid;
  }
};

static_assert(contact::ContactLaw<WeakeningSlider>);

}  // namespace plekton::test
