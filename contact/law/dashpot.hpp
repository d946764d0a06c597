// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/contact_part.hpp"

#include <cmath>
#include <iosfwd>

namespace plekton::contact {

/// A dashpot along the normal, as strong as a restitution wants it: c = 2 xi sqrt(m k), with the
/// reduced mass m of both bodies, the present stiffness k, and the damping ratio xi. It never makes
/// the contact pull. Sources: Tsuji, Tanaka & Ishida, Powder Technology 71 (1992) 239-250; for the
/// end of the contact Schwager & Poeschel, Granular Matter 9 (2007) 465-469.
///
/// A surface that a sphere meets counts as held: of a light free membrane the restitution is lower.
/// The push follows the speed of half a step before, which costs time steps where a heavy sphere
/// meets light nodes.
struct Dashpot : PartDefaults {
  static constexpr std::string_view name = "dashpot";

  struct Properties {
    double damping_ratio = 0.0;  ///< xi >= 0; properties_of() of law_list.hpp takes a restitution
  };

  static void list_problems(const Properties& given, std::ostream& out);

  template <class Real>
  struct ParametersOf {
    Real strength;  ///< sqrt(kg), 2 xi sqrt(m); 0 without mass
  };
  using Parameters = ParametersOf<double>;

  template <class Real>
  struct HistoryOf {
    Real push = Real(0.0);  ///< N, of the last step, along the normal
  };
  using History = HistoryOf<double>;

  static Parameters combine(const Properties& properties, const Body& a, const Body& b) noexcept {
    const double mass = reduced_mass(a, b);
    return {std::isfinite(mass) ? 2.0 * properties.damping_ratio * std::sqrt(mass) : 0.0};
  }
  /// Springs side by side carry one mass.
  static Parameters scaled(const Parameters& p, double) noexcept { return p; }

  /// The dashpot is one for a contact as a whole, not for its bonds.
  static Parameters of_bond(const Parameters&) noexcept { return {0.0}; }

  static double normal_damping(const Parameters& p, const ContactStiffness& stiffness) noexcept {
    return p.strength * std::sqrt(stiffness.normal);
  }

  template <class Real>
  PLEKTON_INLINE static ContactForceOf<Real> force(const ParametersOf<Real>& p,
                                                   const RelativeMotionOf<Real>& motion,
                                                   const ContactStiffnessOf<Real>& stiffness,
                                                   HistoryOf<Real>& history, double dt) noexcept {
    const Real before = history.push;
    const Real push = -p.strength * geometry::square_root(stiffness.normal) * motion.gap_rate;
    history.push = geometry::larger_of(Real(-motion.elastic_normal_force), push);
    return {history.push * motion.normal,
            Real(-0.5) * (before + history.push) * motion.gap_rate * Real(dt)};
  }

  static Vec3 force_of_state(const History& history, const Vec3& normal) noexcept {
    return history.push * normal;
  }

  template <class Real>
  PLEKTON_INLINE static Real history_energy(const ParametersOf<Real>&,
                                            const HistoryOf<Real>&) noexcept {
    return Real(0.0);
  }

  template <class Real>
  PLEKTON_INLINE static void rotate(HistoryOf<Real>& history,
                                    const FrameRotationOf<Real>& rotation) noexcept {
    history.push = rotation.along_normal(history.push);
  }
  static void scale_history(History& history, double factor) noexcept { history.push *= factor; }
  static void accumulate_history(History& history, const History& other, double share) noexcept {
    history.push += std::abs(share) * other.push;
  }
};

static_assert(ContactPart<Dashpot>);

}  // namespace plekton::contact
