// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/linear_frictional.hpp"
#include "contact/law/tangential_spring.hpp"

#include <algorithm>
#include <iosfwd>
#include <type_traits>

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
/// On a surface a sphere has one bond for every contact, at its representative point. Between
/// structures the bonds of a contact together are as many as the contacts it counts for, each a
/// spring between two material points.
struct CohesiveFrictional : LawDefaults {
  static constexpr std::string_view name = "cohesive_frictional";

  struct Properties {
    double tensile_strength = 0.0;  ///< Pa, >= 0
    double shear_strength = 0.0;    ///< Pa, >= 0
    double rupture_distance = 0.0;  ///< m, of yield until a bond breaks; 0: fragile
    Bonds bonds = Bonds::new_contacts;
    LinearFrictional::Properties elastic = {};
  };

  static void list_problems(const Properties& given, std::ostream& out);

  template <class Real>
  struct ParametersOf {
    LinearFrictional::ParametersOf<Real> elastic;
    Real tension;           ///< N, of a bond
    Real shear;             ///< N
    Real rupture_distance;  ///< m
    Real glues;             ///< 1 if it glues bodies that come to touch, else 0; kBeside of a bond
                            ///< beside its contact
    Real compliance;        ///< m/N, along the normal, 0 without stiffness
  };
  using Parameters = ParametersOf<double>;

  /// Between structures: the elastic force is that of the whole contact, and begins and ends without
  /// the bond.
  static constexpr double kBeside = -1.0;

  // What may become of a bond, as numbers: bonds are looked at side by side.
  static constexpr double kNone = 0.0;
  static constexpr double kHolds = 1.0;
  static constexpr double kBroken = -1.0;

  template <class Real>
  struct HistoryOf {
    TangentialSpringOf<Real> spring;
    Real overlap = Real(0.0);  ///< m, u
    Real yielded = Real(0.0);  ///< m, u_p <= 0
    Real pull = Real(0.0);     ///< N, normal force beyond the elastic one; negative in tension
    Real bond = Real(kNone);   ///< or kHolds, kBroken
  };
  using History = HistoryOf<double>;

  static Parameters combine(const Properties& properties, const Body& a, const Body& b) noexcept {
    const double smaller = std::min(a.radius, b.radius);
    return with_compliance({LinearFrictional::combine(properties.elastic, a, b),
                            properties.tensile_strength * smaller * smaller,
                            properties.shear_strength * smaller * smaller,
                            properties.rupture_distance,
                            properties.bonds != Bonds::none ? 1.0 : 0.0, 0.0});
  }
  static Parameters scaled(const Parameters& p, double count) noexcept {
    return with_compliance({LinearFrictional::scaled(p.elastic, count), count * p.tension,
                            count * p.shear, p.rupture_distance, p.glues, 0.0});
  }

  template <class Real>
  PLEKTON_INLINE static Real elastic_normal_force(const ParametersOf<Real>& p,
                                                  const std::type_identity_t<Real>& gap) noexcept {
    return LinearFrictional::elastic_normal_force(p.elastic, gap);
  }
  static double elastic_normal_energy(const Parameters& p, double gap) noexcept {
    return LinearFrictional::elastic_normal_energy(p.elastic, gap);
  }

  /// How far apart (m) bodies may be that are still glued.
  template <class Real>
  PLEKTON_INLINE static Real interaction_range(const ParametersOf<Real>& p) noexcept {
    const Real& k = p.elastic.normal_stiffness;
    return geometry::select(k > Real(0.0), Real(p.rupture_distance + p.tension * p.compliance),
                            Real(0.0));
  }
  /// Whether a contact goes on over a distance.
  static bool holds(const History& history) noexcept { return hold(history) > 0.0; }
  /// The same side by side: positive where it does.
  template <class Real>
  PLEKTON_INLINE static Real hold(const HistoryOf<Real>& history) noexcept {
    return history.bond;
  }

  static bool end_start(Properties& properties) noexcept {
    if (properties.bonds != Bonds::at_start) return false;
    properties.bonds = Bonds::none;
    return true;
  }

  /// A bond without strength is none.
  static bool cements(const Parameters& p) noexcept {
    return p.glues > 0.0 && (p.tension > 0.0 || p.shear > 0.0);
  }
  static void cement(const Parameters&, History& history) noexcept { history.bond = kHolds; }
  static Parameters of_bond(const Parameters& p) noexcept {
    Parameters bond = p;
    bond.glues = kBeside;
    return bond;
  }
  static Parameters unbonded_part(const Parameters& p, double part) noexcept {
    const LinearFrictional::Parameters& e = p.elastic;
    return with_compliance({{e.normal_stiffness, part * e.tangential_stiffness, part * e.friction},
                            0.0,
                            0.0,
                            0.0,
                            0.0,
                            0.0});
  }

  template <class Real>
  PLEKTON_INLINE static ContactForceOf<Real> force(const ParametersOf<Real>& p,
                                                   const RelativeMotionOf<Real>& motion,
                                                   HistoryOf<Real>& history, double dt) noexcept {
    const Real energy_before = bond_energy(p, history);
    const Real bond_before = history.bond;
    const Real pull_before = history.pull;
    const Real overlap_before = history.overlap;
    const Vec3Of<Real> slip = Real(dt) * motion.slip_velocity;
    const Real& stiffness = p.elastic.tangential_stiffness;
    const StiffnessChangeOf<Real> spring(history.spring.compliance, stiffness);
    const Vec3Of<Real> force_before = history.spring.force;
    const TrialForceOf<Real> trial = spring.trial(force_before, slip);
    stretch_bond(p, motion, history);
    shear_bond(p, motion, trial.magnitude, history);
    const Real pressing = motion.elastic_normal_force + history.pull;
    history.spring.force = trial.limited_to(shear_limit(p, history, pressing));
    history.spring.compliance = spring.compliance_now;
    const Real of_spring = spring.dissipated(force_before, history.spring.force, slip);
    // By the way that the overlap went, not by its rate times dt, which differs as the normal turns.
    const Real of_bond =
        energy_before - bond_energy(p, history) +
        Real(0.5) * (pull_before + history.pull) * (history.overlap - overlap_before);
    const Real goes_on_with_it = geometry::smaller_of(bond_before, Real(p.glues - Real(kBeside)));
    const Real of_end = geometry::select(
        goes_on_with_it > Real(0.0),
        pressing_left(overlap_before, history.overlap, Real(history.pull - pull_before)),
        Real(0.0));
    return {total_force(motion.elastic_normal_force, motion.normal, history),
            of_spring + of_bond + of_end};
  }

  /// See TellsForce.
  static Vec3 force_of_state(const Parameters& p, double gap, const Vec3& normal,
                             const History& history) noexcept {
    return total_force(elastic_normal_force(p, gap), normal, history);
  }

  static double tangential_limit(const Parameters& p, double elastic_force,
                                 const History& history) noexcept {
    return shear_limit(p, history, elastic_force + history.pull);
  }

  template <class Real>
  PLEKTON_INLINE static Real history_energy(const ParametersOf<Real>& p,
                                            const HistoryOf<Real>& history) noexcept {
    return history.spring.energy() + bond_energy(p, history);
  }

  template <class Real>
  PLEKTON_INLINE static Real normal_stiffness(const ParametersOf<Real>& p,
                                              const std::type_identity_t<Real>&) noexcept {
    return p.elastic.normal_stiffness;
  }
  template <class Real>
  PLEKTON_INLINE static Real tangential_stiffness(const ParametersOf<Real>& p,
                                                  const std::type_identity_t<Real>&) noexcept {
    return p.elastic.tangential_stiffness;
  }

  template <class Real>
  PLEKTON_INLINE static void rotate(HistoryOf<Real>& history,
                                    const FrameRotationOf<Real>& rotation) noexcept {
    history.spring.force = rotation(history.spring.force);
  }
  static void scale_history(History& history, double factor) noexcept {
    history.spring.scale_history(factor);
    history.pull *= factor;
  }
  /// A bond is one: what comes together has yielded as much as the part that has most.
  static void accumulate_history(History& history, const History& other, double share) noexcept {
    history.spring.accumulate_history(other.spring, share);
    history.overlap = other.overlap;
    history.yielded = std::min(history.yielded, other.yielded);
    history.pull += std::abs(share) * other.pull;
    const bool is_broken = std::min(history.bond, other.bond) < 0.0;
    history.bond = is_broken ? kBroken : std::max(history.bond, other.bond);
  }

 private:
  static Parameters with_compliance(Parameters p) noexcept {
    p.compliance = inverse_of(p.elastic.normal_stiffness);
    return p;
  }

  /// The overlap of one spring with the elastic force there is; over a distance, minus that.
  template <class Real>
  PLEKTON_INLINE static Real overlap_of(const ParametersOf<Real>& p,
                                        const RelativeMotionOf<Real>& motion) noexcept {
    const Real& k = p.elastic.normal_stiffness;
    const Real& force = motion.elastic_normal_force;
    return geometry::select(geometry::smaller_of(force, k) > Real(0.0), Real(force * p.compliance),
                            geometry::smaller_of(Real(-motion.gap), Real(0.0)));
  }

  // Conditions are numbers that are positive where they hold, and all of some hold where the
  // smallest is positive.

  /// Positive for bonds that break at once instead of yielding.
  template <class Real>
  PLEKTON_INLINE static Real is_fragile(const ParametersOf<Real>& p) noexcept {
    return geometry::select(p.rupture_distance > Real(0.0), Real(-1.0), Real(1.0));
  }

  /// The bond along the normal: begins, carries, yields or breaks.
  template <class Real>
  PLEKTON_INLINE static void stretch_bond(const ParametersOf<Real>& p,
                                          const RelativeMotionOf<Real>& motion,
                                          HistoryOf<Real>& history) noexcept {
    using geometry::select;
    using geometry::smaller_of;
    const Real zero = 0.0;
    const Real& k = p.elastic.normal_stiffness;
    history.overlap = overlap_of(p, motion);
    const Real is_none = Real(0.5) - history.bond * history.bond;
    const Real begins = smaller_of(history.overlap, smaller_of(p.glues, is_none));
    history.bond = select(begins > zero, Real(kHolds), history.bond);

    const Real tension = -k * (history.overlap - history.yielded);
    const Real gives_way = smaller_of(Real(tension - p.tension), history.bond);
    const Real yielded =
        select(gives_way > zero, Real(history.overlap + p.tension * p.compliance), history.yielded);
    const Real is_used_up = geometry::larger_of(Real(-yielded - p.rupture_distance), is_fragile(p));
    history.bond = select(smaller_of(gives_way, is_used_up) > zero, Real(kBroken), history.bond);
    history.yielded = select(history.bond > zero, yielded, zero);
    const Real pull = k * (history.overlap - history.yielded) - motion.elastic_normal_force;
    history.pull = select(history.bond > zero, pull, zero);
  }

  /// A fragile bond breaks in shear.
  template <class Real>
  PLEKTON_INLINE static void shear_bond(const ParametersOf<Real>& p,
                                        const RelativeMotionOf<Real>& motion,
                                        const std::type_identity_t<Real>& trial_force,
                                        HistoryOf<Real>& history) noexcept {
    using geometry::select;
    using geometry::smaller_of;
    const Real zero = 0.0;
    const Real limit = shear_limit(p, history, motion.elastic_normal_force + history.pull);
    const Real too_much = trial_force - limit;
    const Real breaks = smaller_of(too_much, smaller_of(is_fragile(p), history.bond));
    history.bond = select(breaks > zero, Real(kBroken), history.bond);
    history.yielded = select(breaks > zero, zero, history.yielded);
    history.pull = select(breaks > zero, zero, history.pull);
  }

  template <class Real>
  PLEKTON_INLINE static Real shear_limit(const ParametersOf<Real>& p,
                                         const HistoryOf<Real>& history,
                                         const std::type_identity_t<Real>& pressing) noexcept {
    const Real of_bond = geometry::select(history.bond > Real(0.0), p.shear, Real(0.0));
    return geometry::positive_part(Real(of_bond + p.elastic.friction * pressing));
  }

  template <class Real>
  PLEKTON_INLINE static Vec3Of<Real> total_force(const Real& elastic_force,
                                                 const Vec3Of<Real>& normal,
                                                 const HistoryOf<Real>& history) noexcept {
    return (elastic_force + history.pull) * normal + history.spring.force;
  }

  /// J, of the elastic force in a step in which bodies that are glued part or meet: what it stored
  /// less what its mean does on the way, as far as the bond goes on with it, so that both together
  /// lose nothing. Where the bond gives way the force ends as it does without one.
  /// @param more  N, by how much the pull has grown
  template <class Real>
  PLEKTON_INLINE static Real pressing_left(const Real& before, const Real& after,
                                           const Real& more) noexcept {
    using geometry::positive_part;
    const Real pressed = positive_part(before) + positive_part(after);
    const Real apart = positive_part(Real(-before)) + positive_part(Real(-after));
    return geometry::select(geometry::smaller_of(pressed, apart) > Real(0.0),
                            Real(Real(0.5) * pressed * more), Real(0.0));
  }

  /// J, beyond that of the elastic force.
  template <class Real>
  PLEKTON_INLINE static Real bond_energy(const ParametersOf<Real>& p,
                                         const HistoryOf<Real>& history) noexcept {
    const Real stretched = history.overlap - history.yielded;
    const Real pressed = geometry::positive_part(history.overlap);
    const Real energy =
        Real(0.5) * p.elastic.normal_stiffness * (stretched * stretched - pressed * pressed);
    return geometry::select(history.bond > Real(0.0), energy, Real(0.0));
  }
};

static_assert(ContactLaw<CohesiveFrictional>);

}  // namespace plekton::contact
