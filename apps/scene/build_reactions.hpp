// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scene/build_scene.hpp"

namespace plekton::apps {

/// Looks up the nodes of the reactions that a scenario asks for, in a scene with its loads.
/// @throws InputError listing every problem, each with its place: supports without nodes, or of
/// nodes of which none is held.
void add_reactions(const Scenario& scenario, BuiltScene& built,
                   const StageBodies* bodies = nullptr);

}  // namespace plekton::apps
