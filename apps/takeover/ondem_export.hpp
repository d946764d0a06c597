// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/run.hpp"
#include "dynamics/ondem/ondem_scene.hpp"

namespace plekton::apps {

/// A simulation as it stands, for other programs: spheres, and rigid bodies of spheres as clumps,
/// in a block for each of their tables, with the contacts between spheres; beside them, as
/// additions, all contacts, membranes, planes and the state with its histories.
/// @param state  that of the simulation
dynamics::OndemScene ondem_scene_of(const Scenario& scenario, const PreparedRun& prepared,
                                    const geometry::StateTree& state);

}  // namespace plekton::apps
