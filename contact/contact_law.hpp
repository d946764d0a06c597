// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/material.hpp"
#include "contact/relative_motion.hpp"
#include "contact/rotation.hpp"

#include <concepts>
#include <string_view>

namespace plekton::contact {

/// What a contact law is: stateless functions of parameters, relative motion and history. It never
/// sees a shape.
///
/// The elastic normal force depends on the gap alone and is summed over the features of a patch by
/// the contact rule; everything else (friction, viscosity, cohesion) is decided once per patch by
/// force().
template <class Law>
concept ContactLaw = requires(const typename Law::Parameters& parameters,
                              const RelativeMotion& motion, typename Law::History& history,
                              const typename Law::History& other, const Material& material,
                              const FrameRotation& rotation, double number) {
  { Law::name } -> std::convertible_to<std::string_view>;
  /// Parameters of a pair of bodies; the numbers are their radii (m).
  { Law::combine(material, number, material, number) } -> std::same_as<typename Law::Parameters>;
  /// Parameters of that many equal contacts side by side.
  { Law::multiplied(parameters, number) } -> std::same_as<typename Law::Parameters>;
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
  /// Adds a share of another contact's history: how contacts split and merge.
  { Law::add_share(history, other, number) } -> std::same_as<void>;
};

/// A law whose force after a step follows from the gap (m), the normal and the history then: it
/// does not have to be kept. To the bit what force() has answered.
template <class Law>
concept TellsForce = requires(const typename Law::Parameters& parameters, double gap,
                              const Vec3& normal, const typename Law::History& history) {
  { Law::force_of_state(parameters, gap, normal, history) } -> std::same_as<Vec3>;
};

}  // namespace plekton::contact
