// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/bonds.hpp"
#include "contact/laws/contact_part.hpp"

namespace plekton::contact {

/// A contact law with something added. A sum is a law: parts can be added one after the other.
template <ContactLaw Whole, ContactPart Part>
struct Sum {
  static constexpr std::string_view name = Whole::name;
  static constexpr bool has_moments = HasMoments<Whole> || HasMoments<Part>;

  struct Properties {
    PropertiesOf<Whole> whole;
    PropertiesOf<Part> part;
  };
  struct Parameters {
    typename Whole::Parameters whole;
    typename Part::Parameters part;
  };
  struct History {
    typename Whole::History whole;
    typename Part::History part;
  };

  static Parameters combine(const Properties& properties, const Body& a, const Body& b) noexcept {
    return {contact::combine<Whole>(properties.whole, a, b), Part::combine(properties.part, a, b)};
  }
  static Parameters multiplied(const Parameters& p, double count) noexcept {
    return {Whole::multiplied(p.whole, count), Part::multiplied(p.part, count)};
  }

  static double elastic_normal_force(const Parameters& p, double gap) noexcept {
    return Whole::elastic_normal_force(p.whole, gap);
  }
  static double elastic_normal_energy(const Parameters& p, double gap) noexcept {
    return Whole::elastic_normal_energy(p.whole, gap);
  }

  static double reach(const Parameters& p) { return reach_of<Whole>(p.whole); }
  static bool holds(const History& history) { return contact::holds<Whole>(history.whole); }

  /// See HasAttraction.
  static double attraction(const Parameters& p) { return attraction_of<Whole>(p.whole); }
  static Parameters without_attraction(const Parameters& p) {
    return {contact::without_attraction<Whole>(p.whole), p.part};
  }

  /// See HasStart and HasBonds.
  static bool end_start(Properties& properties) {
    return contact::end_start<Whole>(properties.whole);
  }
  static bool glues(const Parameters& p) { return contact::glues<Whole>(p.whole); }
  static void glue(const Parameters& p, History& history) {
    contact::glue<Whole>(p.whole, history.whole);
  }
  static Parameters of_bond(const Parameters& p) {
    return {contact::of_bond<Whole>(p.whole), part_of_bond<Part>(p.part)};
  }
  static Parameters beside_bonds(const Parameters& p, double part) {
    return {contact::beside_bonds<Whole>(p.whole, part), part_beside_bonds<Part>(p.part, part)};
  }

  static ContactForce force(const Parameters& p, const RelativeMotion& motion, History& history,
                            double dt) noexcept {
    const ContactForce whole = Whole::force(p.whole, motion, history.whole, dt);
    const ContactForce part =
        Part::force(p.part, motion, stiffness(p, motion.gap), history.part, dt);
    return {whole.force + part.force, whole.dissipated + part.dissipated,
            whole.moment + part.moment};
  }

  /// See HasMoments.
  static Vec3 moment(const History& history, const Vec3& normal) {
    Vec3 moment = Vec3::Zero();
    if constexpr (HasMoments<Whole>) moment += Whole::moment(history.whole, normal);
    if constexpr (HasMoments<Part>) moment += Part::moment(history.part, normal);
    return moment;
  }

  /// See TellsTangentialLimit.
  static double tangential_limit(const Parameters& p, double elastic_force,
                                 const History& history) requires TellsTangentialLimit<Whole> {
    return Whole::tangential_limit(p.whole, elastic_force, history.whole);
  }

  static double history_energy(const Parameters& p, const History& history) noexcept {
    return Whole::history_energy(p.whole, history.whole) +
           Part::history_energy(p.part, history.part);
  }

  static double normal_stiffness(const Parameters& p, double gap) noexcept {
    return Part::effective(p.part, stiffness(p, gap)).normal;
  }
  static double tangential_stiffness(const Parameters& p, double gap) noexcept {
    return Part::effective(p.part, stiffness(p, gap)).tangential;
  }

  static void rotate(History& history, const FrameRotation& rotation) noexcept {
    Whole::rotate(history.whole, rotation);
    Part::rotate(history.part, rotation);
  }
  static void add_share(History& history, const History& other, double share) noexcept {
    Whole::add_share(history.whole, other.whole, share);
    Part::add_share(history.part, other.part, share);
  }

 private:
  /// Of the law without the part.
  static ContactStiffness stiffness(const Parameters& p, double gap) noexcept {
    return {Whole::normal_stiffness(p.whole, gap), Whole::tangential_stiffness(p.whole, gap)};
  }
};

}  // namespace plekton::contact
