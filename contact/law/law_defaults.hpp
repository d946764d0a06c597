// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/relative_motion.hpp"

#include <iosfwd>
#include <limits>

namespace plekton::contact {

/// Which contacts a law with bonds glues.
enum class Bonds {
  new_contacts,  ///< all, where the bodies come to touch
  at_start,      ///< those of the first step
  none
};

/// What a contact law answers where it has nothing to say: laws derive from it, and hide what they
/// know better by functions of the same names.
struct LawDefaults {
  /// Writes a line for whatever is wrong with properties, which begins with what it is and ends in
  /// a line end. Asked when contacts are made; they are not, where there is any.
  template <class Properties>
  static void list_problems(const Properties&, std::ostream&) {}

  /// Damping (N s/m) of motion along the normal at a gap (m).
  template <class Parameters>
  static double normal_damping(const Parameters&, double) noexcept {
    return 0.0;
  }

  /// How large (N) the tangential force may be at a magnitude (N) of the elastic normal force.
  template <class Parameters, class History>
  static double tangential_limit(const Parameters&, double, const History&) noexcept {
    return std::numeric_limits<double>::infinity();
  }

  /// Force (N, on b) after a step beside the elastic normal one, as far as the law tells it. One
  /// that tells its whole force (TellsForce) is not asked.
  template <class Parameters, class History>
  static Vec3 other_force(const Parameters&, const Vec3&, const History&) noexcept {
    return Vec3::Zero();
  }

  /// Makes a history that of so many times as many contacts, each as before (scaled()), of a law
  /// whose history is that of all contacts side by side, as forces are. Else it is that of each, as
  /// slips are.
  template <class History>
  static void scale_history(History&, double) noexcept {}

  // A law under which bodies that touch attract each other with a force that does not depend on how
  // deep. force() and history_energy() have it too; surfaces and structures, whose contacts are
  // counted, take it from here instead and give the law parameters without it.

  /// N, >= 0.
  template <class Parameters>
  static double attraction(const Parameters&) noexcept {
    return 0.0;
  }
  template <class Parameters>
  static Parameters without_attraction(const Parameters& parameters) noexcept {
    return parameters;
  }

  // A law that glues bodies. Between structures a bond is a spring of its own between two material
  // points, and the rest of their contact has what it has beside.

  /// Makes the contacts of the first step the ones of later steps. @returns whether that changed
  /// any
  template <class Properties>
  static bool end_start(Properties&) noexcept {
    return false;
  }
  /// Whether bodies that come to touch stick.
  template <class Parameters>
  static bool cements(const Parameters&) noexcept {
    return false;
  }
  /// The history of ones that do now.
  template <class Parameters, class History>
  static void cement(const Parameters&, History&) noexcept {}
  /// What a bond has of a law with parts.
  template <class Parameters>
  static Parameters of_bond(const Parameters& parameters) noexcept {
    return parameters;
  }
  /// What is left of a contact of which bonds carry all but a part of the tangential force.
  template <class Parameters>
  static Parameters unbonded_part(const Parameters& parameters, double) noexcept {
    return parameters;
  }
};

}  // namespace plekton::contact
