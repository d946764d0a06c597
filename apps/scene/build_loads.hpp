// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scene/build_scene.hpp"

namespace plekton::apps {

/// Adds the loads of a scenario to a scene that is otherwise complete: looks up their nodes, facets
/// and beams.
/// @throws InputError listing every problem, each with its place: sets without nodes, motions that
/// are prescribed twice or held, pressure on a net, a gas in a surface that is not closed.
/// @param bodies  of the stage: how things stood where a load began; nothing: they begin now
void add_loads(const Scenario& scenario, BuiltScene& built, const StageBodies* bodies = nullptr);

}  // namespace plekton::apps
