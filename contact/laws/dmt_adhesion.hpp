// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/laws/hertz_mindlin.hpp"

#include <numbers>

namespace plekton::contact {

/// Elastic bodies that stick together: Hertz and Mindlin, and an attraction 2 pi w R as long as
/// they touch, with R = sqrt(R' R'') of the radii of their curvature against each other
/// (curvature.hpp; Derjaguin, Kolloid-Z. 69 (1934) 155-164). Derjaguin, Muller & Toporov, J.
/// Colloid Interface Sci. 53 (1975) 314-326: for small, stiff bodies. Friction is limited by
/// tan(phi) times the elastic force, what presses the surfaces together: it is there at zero load
/// too (Derjaguin, 1934).
///
/// The attraction acts once on every contact, as it counts: a ball on a flat sheet has one, however
/// many facets there are. Between structures, whose contacts count for more the longer they lie
/// side by side, it is part of the energy that is summed over the region: -(2 pi w R) per contact
/// and overlap, so that it also pulls towards more of it, and an overlap of 0 stores nothing.
///
/// The force jumps where bodies come to touch or part. In the energy of a step of length dt that is
/// an error up to F v dt / 2 of either sign, with F all attraction that begins at once and v the
/// speed of approach: sheets that fall flat on each other want short steps.
struct DmtAdhesion {
  static constexpr std::string_view name = "dmt_adhesion";

  struct Properties {
    double work_of_adhesion = 0.0;  ///< J/m², w, >= 0
  };
  struct Parameters {
    HertzMindlin::Parameters elastic;
    double attraction;  ///< N
  };
  struct History {
    HertzMindlin::History elastic;
    double overlap = 0.0;  ///< m
  };

  static Parameters combine(const Properties& properties, const Body& a, const Body& b) noexcept {
    return {HertzMindlin::combine(a, b), 2.0 * std::numbers::pi * properties.work_of_adhesion *
                                             relative_radii(a, b).equivalent()};
  }
  static Parameters multiplied(const Parameters& p, double count) noexcept {
    return {HertzMindlin::multiplied(p.elastic, count), count * p.attraction};
  }

  static double elastic_normal_force(const Parameters& p, double gap) noexcept {
    return HertzMindlin::elastic_normal_force(p.elastic, gap);
  }
  static double elastic_normal_energy(const Parameters& p, double gap) noexcept {
    return HertzMindlin::elastic_normal_energy(p.elastic, gap);
  }

  /// See HasAttraction.
  static double attraction(const Parameters& p) noexcept { return p.attraction; }
  static Parameters without_attraction(const Parameters& p) noexcept { return {p.elastic, 0.0}; }

  static ContactForce force(const Parameters& p, const RelativeMotion& motion, History& history,
                            double dt) noexcept {
    ContactForce answer = HertzMindlin::force(p.elastic, motion, history.elastic, dt);
    history.overlap = std::max(0.0, -motion.gap);
    if (history.overlap > 0.0) answer.force -= p.attraction * motion.normal;
    return answer;
  }

  /// See TellsTangentialLimit.
  static double tangential_limit(const Parameters& p, double elastic_force,
                                 const History& history) noexcept {
    return HertzMindlin::tangential_limit(p.elastic, elastic_force, history.elastic);
  }

  /// Bodies that touch have given up energy to the attraction.
  static double history_energy(const Parameters& p, const History& history) noexcept {
    return HertzMindlin::history_energy(p.elastic, history.elastic) -
           p.attraction * history.overlap;
  }

  static double normal_stiffness(const Parameters& p, double gap) noexcept {
    return HertzMindlin::normal_stiffness(p.elastic, gap);
  }
  static double tangential_stiffness(const Parameters& p, double gap) noexcept {
    return HertzMindlin::tangential_stiffness(p.elastic, gap);
  }

  static void rotate(History& history, const FrameRotation& rotation) noexcept {
    HertzMindlin::rotate(history.elastic, rotation);
  }
  static void add_share(History& history, const History& other, double share) noexcept {
    HertzMindlin::add_share(history.elastic, other.elastic, share);
    history.overlap += share * other.overlap;
  }
};

static_assert(ContactLaw<DmtAdhesion>);

}  // namespace plekton::contact
