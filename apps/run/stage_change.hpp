// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/run.hpp"
#include "geometry/base/state_tree.hpp"

#include <vector>

/// From the end of a stage to the start of the next one.
namespace plekton::apps {

/// Of a checkpoint of a scenario with stages.
struct StageOfState {
  StageBodies bodies;
  bool has_ended = false;
};
/// @throws InputError if the state is one of a scenario without stages
StageOfState stage_of(const geometry::StateTree& state);

/// @param simulation  of the stage
/// @throws InputError where nothing moves from which a time step could be chosen, and none is given
void require_something_free(const Scenario& stage, const dynamics::Simulation& simulation);

/// A simulation of the stage in which a state is; it has yet to be restored.
PreparedRun prepare_stage(const Scenario& stage, const geometry::StateTree& state,
                          const HearSetUp& hear = {});

/// A simulation of the next stage, which goes on from the one before.
struct StageBegin {
  PreparedRun prepared;
  geometry::StateTree run;  ///< what a run knows beside its simulation, for kRunGroup
};
/// @param before  where it has ended
/// @param state   of its run then
/// @throws InputError also where no grain is left for a load, or new ones do not fit
StageBegin next_stage(const Scenario& stage, PreparedRun& before, const geometry::StateTree& state,
                      const HearSetUp& hear = {});

}  // namespace plekton::apps
