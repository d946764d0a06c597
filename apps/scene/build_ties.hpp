// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scene/build_scene.hpp"

namespace plekton::apps {

/// Adds the ties of a scenario between its membranes and rigid bodies where these are made, so that
/// they are the same in all stages, and nodes to the rigid bodies that hold others where they are:
/// of these there have to be as many before the grains in every stage.
/// @throws InputError listing every problem: no nodes to tie, cables that are no chains, ties
///         without a stiffness
void add_ties(const Scenario& scenario, BuiltScene& built);

}  // namespace plekton::apps
