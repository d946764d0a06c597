// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/material.hpp"
#include "contact/base/relative_motion.hpp"
#include "contact/base/rotation.hpp"
#include "contact/law/law_defaults.hpp"

#include <concepts>
#include <iosfwd>
#include <string_view>

namespace plekton::contact {

namespace detail {

struct NoProperties {
  friend bool operator==(const NoProperties&, const NoProperties&) = default;
};
template <class Law>
struct PropertiesOf {
  using Type = NoProperties;
};
template <class Law>
requires requires {
  typename Law::Properties;
}
struct PropertiesOf<Law> {
  using Type = typename Law::Properties;
};

}  // namespace detail

/// Numbers that a law has for a pair of materials, not for each of them: of most laws there are
/// none.
template <class Law>
using PropertiesOf = typename detail::PropertiesOf<Law>::Type;

/// Parameters of a pair of bodies.
template <class Law>
typename Law::Parameters combine(const PropertiesOf<Law>& properties, const Body& a,
                                 const Body& b) {
  if constexpr (requires { typename Law::Properties; }) {
    return Law::combine(properties, a, b);
  } else {
    return Law::combine(a, b);
  }
}

/// What a contact law is: stateless functions of parameters, relative motion and history. It never
/// sees a shape.
///
/// Its Parameters, History and Properties are structs of plain numbers, copied bit by bit: no
/// pointers, strings or containers; each can be made without arguments. Parameters have at most the
/// size of 24 doubles, a History and Properties that of 16 each. Bytes between members are no part
/// of the state, but clang below 20 cannot leave them out: members of one size, or with the gaps
/// filled by members of their own, have the same state there too.
///
/// Its functions must not throw: loops over contacts run in several threads and end the program
/// then. What is wrong with properties is said before, by list_problems(). Stiffnesses and forces
/// are finite. They are called at any time and from any thread, so that they keep nothing beside
/// the history.
///
/// The elastic normal force depends on the gap alone and is summed over the features of a patch by
/// the contact rule; everything else (friction, viscosity, cohesion) is decided once per patch by
/// force().
///
/// What it has nothing to say about it takes from LawDefaults, which it derives from.
template <class Law>
concept ContactLaw = requires(const typename Law::Parameters& parameters,
                              const RelativeMotion& motion, typename Law::History& history,
                              const typename Law::History& other, const Body& body,
                              const FrameRotation& rotation, double number, const Vec3& vector,
                              PropertiesOf<Law>& properties, std::ostream& out) {
  { Law::name } -> std::convertible_to<std::string_view>;
  /// Parameters of a pair of bodies. A law with a type Properties takes them first.
  { combine<Law>(PropertiesOf<Law>{}, body, body) } -> std::same_as<typename Law::Parameters>;
  /// Parameters of that many equal contacts side by side.
  { Law::scaled(parameters, number) } -> std::same_as<typename Law::Parameters>;
  /// Elastic normal force (N) of one feature at a gap (m); 0 for a gap >= 0.
  { Law::elastic_normal_force(parameters, number) } -> std::same_as<double>;
  /// Energy (J) stored by that force.
  { Law::elastic_normal_energy(parameters, number) } -> std::same_as<double>;
  /// Total force on body b after a step of the given length (s).
  { Law::force(parameters, motion, history, number) } -> std::same_as<ContactForce>;
  /// Energy (J) stored by the history.
  { Law::history_energy(parameters, other) } -> std::same_as<double>;
  /// Stiffness (N/m) of one feature at a gap (m), normal and tangential, for the time step.
  { Law::normal_stiffness(parameters, number) } -> std::same_as<double>;
  { Law::tangential_stiffness(parameters, number) } -> std::same_as<double>;
  /// Turns the history with the contact frame.
  { Law::rotate(history, rotation) } -> std::same_as<void>;
  /// Adds a share of another contact's history: how contacts split and merge. A negative one is of
  /// a contact whose bodies are the other way round: what points along the contact turns round with
  /// it, what goes along the normal does not.
  { Law::accumulate_history(history, other, number) } -> std::same_as<void>;

  // One that is written for moments has them told (HasMoments).
  requires !requires {
    requires Law::has_moments;
  }
  || requires(const Vec3& normal) {
    Law::moment(other, normal);
  };

  // See LawDefaults.
  { Law::list_problems(properties, out) } -> std::same_as<void>;
  { Law::normal_damping(parameters, number) } -> std::same_as<double>;
  { Law::tangential_limit(parameters, number, other) } -> std::same_as<double>;
  { Law::other_force(parameters, vector, other) } -> std::same_as<Vec3>;
  { Law::scale_history(history, number) } -> std::same_as<void>;
  { Law::attraction(parameters) } -> std::same_as<double>;
  { Law::without_attraction(parameters) } -> std::same_as<typename Law::Parameters>;
  { Law::end_start(properties) } -> std::same_as<bool>;
  { Law::cements(parameters) } -> std::same_as<bool>;
  { Law::cement(parameters, history) } -> std::same_as<void>;
  { Law::of_bond(parameters) } -> std::same_as<typename Law::Parameters>;
  { Law::unbonded_part(parameters, number) } -> std::same_as<typename Law::Parameters>;
};

// What loops are compiled without for a law that does not have it.

/// A law that answers with moments too, and tells the moment (N m, on b) of the last step from the
/// history and the normal then: moment(history, normal).
template <class Law>
concept HasMoments = requires(const typename Law::History& history, const Vec3& normal) {
  { Law::moment(history, normal) } -> std::same_as<Vec3>;
};

/// N m, on b, of the last step.
template <class Law>
Vec3 moment_of(const typename Law::History& history, const Vec3& normal) {
  if constexpr (HasMoments<Law>) {
    return Law::moment(history, normal);
  } else {
    return Vec3::Zero();
  }
}

/// A law whose force after a step follows from the gap (m), the normal and the history then: it
/// does not have to be kept. To the bit what force() has answered; and at a gap of 0, where the
/// elastic normal force is none, all else of it.
template <class Law>
concept TellsForce = requires(const typename Law::Parameters& parameters, double gap,
                              const Vec3& normal, const typename Law::History& history) {
  { Law::force_of_state(parameters, gap, normal, history) } -> std::same_as<Vec3>;
};

/// Force (N, on b) of the last step but for the elastic normal one, as far as the law tells it.
template <class Law>
Vec3 other_force(const typename Law::Parameters& parameters, const Vec3& normal,
                 const typename Law::History& history) {
  if constexpr (TellsForce<Law>) {
    return Law::force_of_state(parameters, 0.0, normal, history);
  } else {
    return Law::other_force(parameters, normal, history);
  }
}

/// A law whose contacts may go on over a distance, because the bodies stick to each other.
///
/// interaction_range(parameters): how far apart (m) the surfaces may be; holds(history): whether
/// they stick.
template <class Law>
concept HasInteractionRange = requires(const typename Law::Parameters& parameters,
                                       const typename Law::History& history) {
  { Law::interaction_range(parameters) } -> std::same_as<double>;
  { Law::holds(history) } -> std::same_as<bool>;
};

/// m, 0 for laws that only push.
template <class Law>
double interaction_range_of(const typename Law::Parameters& parameters) {
  if constexpr (HasInteractionRange<Law>) {
    return Law::interaction_range(parameters);
  } else {
    return 0.0;
  }
}

/// Whether bodies with this history stick to each other.
template <class Law>
bool holds(const typename Law::History& history) {
  if constexpr (HasInteractionRange<Law>) {
    return Law::holds(history);
  } else {
    return false;
  }
}

/// Whether a contact with this history goes on at a gap (m) that is not negative.
template <class Law>
bool goes_on(const typename Law::Parameters& parameters, const typename Law::History& history,
             double gap) {
  return holds<Law>(history) && gap < interaction_range_of<Law>(parameters);
}

}  // namespace plekton::contact
