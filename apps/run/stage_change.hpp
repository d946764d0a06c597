// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/run.hpp"
#include "geometry/base/state_tree.hpp"

#include <cstddef>
#include <memory>
#include <string>
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

/// A stage before anything is run.
struct StageAhead {
  BuiltScene built;  ///< without its scene, which is the simulation's
  std::unique_ptr<dynamics::Simulation> simulation;
  std::vector<std::string> warnings;
};

/// The stages of a scenario as far as they can be known before any is run: bodies where they are
/// made, without grains that are taken out wherever they are.
class StagesAhead {
 public:
  StagesAhead(const Scenario& first, const BuiltScene& built);

  /// The next one, from the second on.
  /// @throws InputError as next_stage() would, where what comes begins behind a plane that has not
  ///         moved, or in what comes with it; where it begins in what may have moved is a warning
  StageAhead next(const Scenario& stage, const HearSetUp& hear = {});

 private:
  void find_planes(const Scenario& stage);
  /// @param nodes_before  how many there were in the stage before
  /// @param was_absent    by node, in the stage before
  void look_at_arrivals(const Scenario& stage, std::size_t nodes_before,
                        const std::vector<bool>& was_absent, StageAhead& ahead) const;

  StageBodies bodies_;
  std::vector<Vec3> positions_;   // m
  std::vector<bool> has_stayed_;  // by plane: it is where its keys put it
};

}  // namespace plekton::apps
