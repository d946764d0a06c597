// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/contact_law.hpp"

namespace plekton::contact {

/// N/m, of a contact. Real is double, or a Pack for contacts side by side.
template <class Real>
struct ContactStiffnessOf {
  Real normal;
  Real tangential;
};
using ContactStiffness = ContactStiffnessOf<double>;

/// What a part answers where it has nothing to say, as LawDefaults of a law. The stiffness is that
/// of the law it is added to.
struct PartDefaults {
  /// See LawDefaults.
  template <class Properties>
  static void list_problems(const Properties&, std::ostream&) {}

  /// Damping (N s/m) of motion along the normal.
  template <class Parameters>
  static double normal_damping(const Parameters&, const ContactStiffness&) noexcept {
    return 0.0;
  }
  /// See LawDefaults.
  template <class History>
  static void scale_history(History&, double) noexcept {}

  /// The stiffness that a time step has to be safe for: of a part that is as stiff as something in
  /// the law's slip more than the law's.
  template <class Parameters, class Real>
  PLEKTON_INLINE static ContactStiffnessOf<Real> effective(
      const Parameters&, const ContactStiffnessOf<Real>& stiffness) noexcept {
    return stiffness;
  }

  // What a bond has of a part, and a contact beside bonds: of one that says nothing about them all,
  // as the stiffness that comes with the law is divided already.
  template <class Parameters>
  static Parameters of_bond(const Parameters& parameters) noexcept {
    return parameters;
  }
  template <class Parameters>
  static Parameters unbonded_part(const Parameters& parameters, double) noexcept {
    return parameters;
  }
};

/// What can be added to a contact law (sum.hpp): forces and moments that come on top of its own,
/// such as resistance to rolling, or a dashpot. It has no elastic normal force, and knows of the
/// law it is added to the stiffness alone. What it has nothing to say about it takes from
/// PartDefaults, which it derives from; one with moments tells them (HasMoments).
template <class Part>
concept ContactPart = requires(const typename Part::Properties& properties,
                               const typename Part::Parameters& parameters, const Body& body,
                               const RelativeMotion& motion, const ContactStiffness& stiffness,
                               typename Part::History& history, const typename Part::History& other,
                               const FrameRotation& rotation, const Vec3& normal, double number,
                               std::ostream& out) {
  { Part::name } -> std::convertible_to<std::string_view>;
  { Part::combine(properties, body, body) } -> std::same_as<typename Part::Parameters>;
  { Part::scaled(parameters, number) } -> std::same_as<typename Part::Parameters>;
  /// What is added to the law's answer, of a step of the given length (s).
  { Part::force(parameters, motion, stiffness, history, number) } -> std::same_as<ContactForce>;
  /// Its force (N) after a step, from the history and the normal then: to the bit that of force().
  { Part::force_of_state(other, normal) } -> std::same_as<Vec3>;
  /// Energy (J) stored by the history.
  { Part::history_energy(parameters, other) } -> std::same_as<double>;
  { Part::rotate(history, rotation) } -> std::same_as<void>;
  { Part::accumulate_history(history, other, number) } -> std::same_as<void>;

  // See PartDefaults.
  { Part::list_problems(properties, out) } -> std::same_as<void>;
  { Part::normal_damping(parameters, stiffness) } -> std::same_as<double>;
  { Part::scale_history(history, number) } -> std::same_as<void>;
  { Part::effective(parameters, stiffness) } -> std::same_as<ContactStiffness>;
  { Part::of_bond(parameters) } -> std::same_as<typename Part::Parameters>;
  { Part::unbonded_part(parameters, number) } -> std::same_as<typename Part::Parameters>;
};

}  // namespace plekton::contact
