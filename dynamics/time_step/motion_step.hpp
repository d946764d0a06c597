// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"

#include <cstdint>

/// How long a time step may be for contacts to follow the motion, whatever its stability: soft,
/// large or fast bodies move further than their own size in a step that is stable.
namespace plekton::dynamics {

/// A node moves at most by this part of the smallest radius in a chosen step.
///
/// Two bodies then come nearer by at most a fifth of the smallest radius in a step, and centres
/// that meet are at least a radius apart when they touch: a contact is felt in five steps or more
/// before one could pass through the other, and the overlap at first sight is below a fifth of the
/// radius.
constexpr double kLargestMotion = 0.1;

/// A chosen time step is looked at again after so many steps.
constexpr std::int64_t kStepsBetweenLooks = 64;

/// m/s, of any node, held or not.
double largest_speed(const NodeState& state) noexcept;

/// Longest step dt (s) in which nothing moves further than kLargestMotion of a radius until the
/// step is looked at again: (speed + kStepsBetweenLooks gravity dt) dt <= kLargestMotion radius.
///
/// Contact forces need no place in this: they push bodies apart by at most about their overlap in a
/// step, since a chosen step is below 1 / omega.
/// @param speed    m/s, at least 0
/// @param gravity  m/s², at least 0, the acceleration that goes on until then
/// @param radius   m, > 0; infinite where nothing can touch
/// @returns        infinite where nothing moves or nothing can touch
double longest_step(double speed, double gravity, double radius) noexcept;

}  // namespace plekton::dynamics
