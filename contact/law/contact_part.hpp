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

/// What can be added to a contact law (sum.hpp): forces and moments that come on top of its own,
/// such as resistance to rolling, or a dashpot. It has no elastic normal force, and knows of the
/// law it is added to the stiffness alone.
template <class Part>
concept ContactPart = requires(const typename Part::Properties& properties,
                               const typename Part::Parameters& parameters, const Body& body,
                               const RelativeMotion& motion, const ContactStiffness& stiffness,
                               typename Part::History& history, const typename Part::History& other,
                               const FrameRotation& rotation, double number) {
  { Part::name } -> std::convertible_to<std::string_view>;
  { Part::combine(properties, body, body) } -> std::same_as<typename Part::Parameters>;
  { Part::scaled(parameters, number) } -> std::same_as<typename Part::Parameters>;
  /// What is added to the law's answer, of a step of the given length (s).
  { Part::force(parameters, motion, stiffness, history, number) } -> std::same_as<ContactForce>;
  /// Energy (J) stored by the history.
  { Part::history_energy(parameters, other) } -> std::same_as<double>;
  { Part::rotate(history, rotation) } -> std::same_as<void>;
  { Part::accumulate_history(history, other, number) } -> std::same_as<void>;
};

/// A part whose force after a step follows from its history and the normal then (TellsForce).
template <class Part>
concept PartTellsForce = requires(const typename Part::History& history, const Vec3& normal) {
  { Part::force_of_state(history, normal) } -> std::same_as<Vec3>;
};

/// A part that is as stiff as something in a law's slip.
///
/// effective(parameters, stiffness): the stiffness that a time step has to be safe for, of a law
/// that has this one.
template <class Part>
concept PartStiffens = requires(const typename Part::Parameters& parameters,
                                const ContactStiffness& stiffness) {
  { Part::effective(parameters, stiffness) } -> std::same_as<ContactStiffness>;
};

/// A part that damps motion along the normal: by normal_damping(parameters, stiffness) (N s/m) of a
/// law that has this stiffness.
template <class Part>
concept PartDamps = requires(const typename Part::Parameters& parameters,
                             const ContactStiffness& stiffness) {
  { Part::normal_damping(parameters, stiffness) } -> std::same_as<double>;
};

/// A part whose history is that of all contacts side by side: see ScalesHistory.
template <class Part>
concept PartScalesHistory = requires(typename Part::History& history, double factor) {
  { Part::scale_history(history, factor) } -> std::same_as<void>;
};

/// What a bond has of a part, and a contact beside bonds (HasBonds): of one that says nothing about
/// them all, as the stiffness that comes with the law is divided already.
template <ContactPart Part>
typename Part::Parameters part_of_bond(const typename Part::Parameters& parameters) {
  if constexpr (requires { Part::of_bond(parameters); }) {
    return Part::of_bond(parameters);
  } else {
    return parameters;
  }
}
template <ContactPart Part>
typename Part::Parameters part_unbonded(const typename Part::Parameters& parameters, double part) {
  if constexpr (requires { Part::unbonded_part(parameters, part); }) {
    return Part::unbonded_part(parameters, part);
  } else {
    return parameters;
  }
}

}  // namespace plekton::contact
