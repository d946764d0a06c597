// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/bonds.hpp"
#include "contact/laws/linear_frictional.hpp"
#include "contact/laws/tangential_spring.hpp"

#include <algorithm>
#include <limits>

namespace plekton::contact {

/// Linear springs that are glued where they touch first: the bond carries tension up to
/// tensile_strength min(R_a, R_b)^2, and shear beyond friction by shear_strength min(R_a, R_b)^2.
/// As Bourrier, Kneib, Chareyre & Fourcaud, Ecological Engineering 61 (2013) 646-657, without a
/// factor of pi.
///
/// With an overlap u (negative: a distance) the normal force is k_n (u - u_p). A fragile bond
/// breaks where it would carry more than it can, in tension or in shear; from then on there is
/// friction alone, until the bodies have parted: then they may be glued anew. A ductile one yields
/// instead: u_p follows, and it breaks once it has yielded by the rupture distance.
///
/// On a surface a ball has one bond for every contact, at its representative point. Between
/// structures the bonds of a contact together are as many as the contacts it counts for, each a
/// spring between two material points (structure/structure_bond.hpp).
struct CohesiveFrictional {
  static constexpr std::string_view name = "cohesive_frictional";

  struct Properties {
    double tensile_strength = 0.0;  ///< Pa, >= 0
    double shear_strength = 0.0;    ///< Pa, >= 0
    double rupture_distance = 0.0;  ///< m, of yield until a bond breaks; 0: fragile
    Bonds bonds = Bonds::new_contacts;
    LinearFrictional::Properties elastic = {};
  };
  struct Parameters {
    LinearFrictional::Parameters elastic;
    double tension;           ///< N, of a bond
    double shear;             ///< N
    double rupture_distance;  ///< m
    bool glues;               ///< bodies that come to touch
  };
  enum class Bond : std::int64_t { none, holds, broken };
  struct History {
    TangentialSpring spring;
    double overlap = 0.0;  ///< m, u
    double yielded = 0.0;  ///< m, u_p <= 0
    double pull = 0.0;     ///< N, normal force beyond the elastic one; negative in tension
    Bond bond = Bond::none;
  };

  static Parameters combine(const Properties& properties, const Body& a, const Body& b) noexcept {
    const double smaller = std::min(a.radius, b.radius);
    return {LinearFrictional::combine(properties.elastic, a, b),
            properties.tensile_strength * smaller * smaller,
            properties.shear_strength * smaller * smaller, properties.rupture_distance,
            properties.bonds != Bonds::none};
  }
  static Parameters multiplied(const Parameters& p, double count) noexcept {
    return {LinearFrictional::multiplied(p.elastic, count), count * p.tension, count * p.shear,
            p.rupture_distance, p.glues};
  }

  static double elastic_normal_force(const Parameters& p, double gap) noexcept {
    return LinearFrictional::elastic_normal_force(p.elastic, gap);
  }
  static double elastic_normal_energy(const Parameters& p, double gap) noexcept {
    return LinearFrictional::elastic_normal_energy(p.elastic, gap);
  }

  /// How far apart (m) bodies may be that are still glued.
  static double reach(const Parameters& p) noexcept {
    const double k = p.elastic.normal_stiffness;
    return k > 0.0 ? p.rupture_distance + p.tension / k : 0.0;
  }
  /// Whether a contact goes on over a distance.
  static bool holds(const History& history) noexcept { return history.bond == Bond::holds; }

  /// See HasStart.
  static bool end_start(Properties& properties) noexcept {
    if (properties.bonds != Bonds::at_start) return false;
    properties.bonds = Bonds::none;
    return true;
  }

  /// See HasBonds. A bond without strength is none.
  static bool glues(const Parameters& p) noexcept {
    return p.glues && (p.tension > 0.0 || p.shear > 0.0);
  }
  static void glue(const Parameters&, History& history) noexcept { history.bond = Bond::holds; }
  static Parameters of_bond(const Parameters& p) noexcept { return p; }
  static Parameters beside_bonds(const Parameters& p, double part) noexcept {
    const LinearFrictional::Parameters& e = p.elastic;
    return {{e.normal_stiffness, part * e.tangential_stiffness, part * e.friction},
            0.0,
            0.0,
            0.0,
            false};
  }

  static ContactForce force(const Parameters& p, const RelativeMotion& motion, History& history,
                            double dt) noexcept {
    const double energy_before = bond_energy(p, history);
    const double pull_before = history.pull;
    move_bond(p, motion, history);
    const double pressing = motion.elastic_normal_force + history.pull;
    double dissipated = 0.0;
    const Vec3 slip = dt * motion.slip_velocity;
    const double stiffness = p.elastic.tangential_stiffness;
    if (history.bond == Bond::holds && p.rupture_distance == 0.0 &&
        (history.spring.force - stiffness * slip).norm() > shear_limit(p, history, pressing)) {
      release(history);
    }
    const double limit = shear_limit(p, history, motion.elastic_normal_force + history.pull);
    dissipated += history.spring.advance(slip, stiffness, limit);
    dissipated += energy_before - bond_energy(p, history) -
                  0.5 * (pull_before + history.pull) * motion.gap_rate * dt;
    return {(motion.elastic_normal_force + history.pull) * motion.normal + history.spring.force,
            dissipated};
  }

  /// See TellsTangentialLimit.
  static double tangential_limit(const Parameters& p, double elastic_force,
                                 const History& history) noexcept {
    return shear_limit(p, history, elastic_force + history.pull);
  }

  static double history_energy(const Parameters& p, const History& history) noexcept {
    return history.spring.energy() + bond_energy(p, history);
  }

  static double normal_stiffness(const Parameters& p, double) noexcept {
    return p.elastic.normal_stiffness;
  }
  static double tangential_stiffness(const Parameters& p, double) noexcept {
    return p.elastic.tangential_stiffness;
  }

  static void rotate(History& history, const FrameRotation& rotation) noexcept {
    history.spring.force = rotation(history.spring.force);
  }
  /// A bond is one: what comes together has yielded as much as the part that has most.
  static void add_share(History& history, const History& other, double share) noexcept {
    history.spring.add_share(other.spring, share);
    history.overlap = other.overlap;
    history.yielded = std::min(history.yielded, other.yielded);
    history.pull += share * other.pull;
    history.bond = std::max(history.bond, other.bond);
  }

 private:
  /// The overlap of one spring with the elastic force there is; over a distance, minus that.
  static double overlap_of(const Parameters& p, const RelativeMotion& motion) noexcept {
    const bool touches = motion.elastic_normal_force > 0.0 && p.elastic.normal_stiffness > 0.0;
    return touches ? motion.elastic_normal_force / p.elastic.normal_stiffness
                   : std::min(0.0, -motion.gap);
  }

  static void move_bond(const Parameters& p, const RelativeMotion& motion,
                        History& history) noexcept {
    const double k = p.elastic.normal_stiffness;
    history.overlap = overlap_of(p, motion);
    if (history.bond == Bond::none && history.overlap > 0.0 && p.glues) history.bond = Bond::holds;
    if (history.bond != Bond::holds) return release(history, history.bond);
    if (-k * (history.overlap - history.yielded) > p.tension) {
      if (p.rupture_distance == 0.0) return release(history);
      history.yielded = history.overlap + p.tension / k;
      if (-history.yielded > p.rupture_distance) return release(history);
    }
    history.pull = k * (history.overlap - history.yielded) - motion.elastic_normal_force;
  }

  static void release(History& history, Bond next = Bond::broken) noexcept {
    history.bond = next;
    history.pull = 0.0;
    history.yielded = 0.0;
  }

  static double shear_limit(const Parameters& p, const History& history, double pressing) noexcept {
    const double glue = history.bond == Bond::holds ? p.shear : 0.0;
    return std::max(0.0, glue + p.elastic.friction * pressing);
  }

  /// J, beyond that of the elastic force.
  static double bond_energy(const Parameters& p, const History& history) noexcept {
    if (history.bond != Bond::holds) return 0.0;
    const double stretched = history.overlap - history.yielded;
    const double pressed = std::max(0.0, history.overlap);
    return 0.5 * p.elastic.normal_stiffness * (stretched * stretched - pressed * pressed);
  }
};

static_assert(ContactLaw<CohesiveFrictional>);
static_assert(HasBonds<CohesiveFrictional> && HasStart<CohesiveFrictional>);

}  // namespace plekton::contact
