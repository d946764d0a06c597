// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/hertz_mindlin.hpp"

#include <cmath>
#include <iosfwd>
#include <numbers>

namespace plekton::contact {

/// Elastic bodies that stick together: Hertz and Mindlin, and an attraction 2 pi w R as long as
/// they touch, with R = sqrt(R' R'') of the radii of their curvature against each other
/// (curvature.hpp; Derjaguin, Kolloid-Z. 69 (1934) 155-164). Derjaguin, Muller & Toporov, J.
/// Colloid Interface Sci. 53 (1975) 314-326: for small, stiff bodies. Friction is limited by
/// tan(phi) times the elastic force, what presses the surfaces together: it is there at zero load
/// too (Derjaguin, 1934).
///
/// The attraction acts on what counts as a contact: once on a sphere on a flat sheet,
/// however many facets there are, and from each side of a groove. It is part of the energy that is
/// summed, -(2 pi w R) per contact and overlap: so between structures, whose contacts count for more
/// the longer they lie side by side, it also pulls towards more of it, and an overlap of 0 stores
/// nothing.
///
/// The force jumps where bodies come to touch or part. In the energy of a step of length dt that is
/// an error up to F v dt / 2 of either sign, with F all attraction that begins at once and v the
/// speed of approach: sheets that fall flat on each other want short steps.
struct DmtAdhesion : LawDefaults {
  static constexpr std::string_view name = "dmt_adhesion";

  struct Properties {
    double work_of_adhesion = 0.0;  ///< J/m², w, >= 0
  };

  static void list_problems(const Properties& given, std::ostream& out);

  template <class Real>
  struct ParametersOf {
    HertzMindlin::ParametersOf<Real> elastic;
    Real attraction;  ///< N
  };
  using Parameters = ParametersOf<double>;

  template <class Real>
  struct HistoryOf {
    HertzMindlin::HistoryOf<Real> elastic;
    Real overlap = Real(0.0);  ///< m
  };
  using History = HistoryOf<double>;

  static Parameters combine(const Properties& properties, const Body& a, const Body& b) noexcept {
    return {HertzMindlin::combine(a, b), 2.0 * std::numbers::pi * properties.work_of_adhesion *
                                             relative_radii(a, b).equivalent()};
  }
  static Parameters scaled(const Parameters& p, double count) noexcept {
    return {HertzMindlin::scaled(p.elastic, count), count * p.attraction};
  }

  template <class Real>
  PLEKTON_INLINE static Real elastic_normal_force(const ParametersOf<Real>& p,
                                                  const std::type_identity_t<Real>& gap) noexcept {
    return HertzMindlin::elastic_normal_force(p.elastic, gap);
  }
  static double elastic_normal_energy(const Parameters& p, double gap) noexcept {
    return HertzMindlin::elastic_normal_energy(p.elastic, gap);
  }

  static double attraction(const Parameters& p) noexcept { return p.attraction; }
  static Parameters without_attraction(const Parameters& p) noexcept { return {p.elastic, 0.0}; }

  template <class Real>
  PLEKTON_INLINE static ContactForceOf<Real> force(const ParametersOf<Real>& p,
                                                   const RelativeMotionOf<Real>& motion,
                                                   HistoryOf<Real>& history, double dt) noexcept {
    ContactForceOf<Real> answer = HertzMindlin::force(p.elastic, motion, history.elastic, dt);
    history.overlap = geometry::positive_part(Real(-motion.gap));
    answer.force = answer.force - pull(p, history) * motion.normal;
    return answer;
  }

  /// See TellsForce.
  static Vec3 force_of_state(const Parameters& p, double gap, const Vec3& normal,
                             const History& history) noexcept {
    const Vec3 elastic = HertzMindlin::force_of_state(p.elastic, gap, normal, history.elastic);
    return elastic - pull(p, history) * normal;
  }

  static double tangential_limit(const Parameters& p, double elastic_force,
                                 const History& history) noexcept {
    return HertzMindlin::tangential_limit(p.elastic, elastic_force, history.elastic);
  }

  /// Bodies that touch have given up energy to the attraction.
  template <class Real>
  PLEKTON_INLINE static Real history_energy(const ParametersOf<Real>& p,
                                            const HistoryOf<Real>& history) noexcept {
    return HertzMindlin::history_energy(p.elastic, history.elastic) -
           p.attraction * history.overlap;
  }

  template <class Real>
  PLEKTON_INLINE static Real normal_stiffness(const ParametersOf<Real>& p,
                                              const std::type_identity_t<Real>& gap) noexcept {
    return HertzMindlin::normal_stiffness(p.elastic, gap);
  }
  template <class Real>
  PLEKTON_INLINE static Real tangential_stiffness(const ParametersOf<Real>& p,
                                                  const std::type_identity_t<Real>& gap) noexcept {
    return HertzMindlin::tangential_stiffness(p.elastic, gap);
  }

  template <class Real>
  PLEKTON_INLINE static void rotate(HistoryOf<Real>& history,
                                    const FrameRotationOf<Real>& rotation) noexcept {
    HertzMindlin::rotate(history.elastic, rotation);
  }
  static void scale_history(History& history, double factor) noexcept {
    HertzMindlin::scale_history(history.elastic, factor);
  }
  static void accumulate_history(History& history, const History& other, double share) noexcept {
    HertzMindlin::accumulate_history(history.elastic, other.elastic, share);
    history.overlap += std::abs(share) * other.overlap;
  }

 private:
  /// N, of bodies that touch.
  template <class Real>
  PLEKTON_INLINE static Real pull(const ParametersOf<Real>& p,
                                  const HistoryOf<Real>& history) noexcept {
    return geometry::select(history.overlap > Real(0.0), p.attraction, Real(0.0));
  }
};

static_assert(ContactLaw<DmtAdhesion>);

}  // namespace plekton::contact
