// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/run.hpp"
#include "apps/run/stage_change.hpp"

#include <cstddef>
#include <functional>
#include <string>

namespace plekton::apps {

/// Which stages are run, and who hears of them.
struct StagesToRun {
  std::size_t last = 0;  ///< number of the last one
  std::function<void(const Scenario& stage, const PreparedRun&)> begins;
  std::function<void(const Scenario& stage, const RunReport&)> ends;
  HearSetUp hear = {};
};

/// Runs the stages of a scenario one after the other: each as a run that goes on from the end of
/// the one before, in the same files. At the end of each there is a checkpoint.
/// @param first     the first of them to be run
/// @param settings  where the first one goes on from, if it does
/// @throws StageFailed, and all that run() throws, with the stages before it written
RunReport run_stages(const Scenario& scenario, PreparedRun first, const RunSettings& settings,
                     const StagesToRun& stages);

/// The state at the end of a stage of an earlier run in a folder, whatever is wrong with its other
/// checkpoints.
/// @throws InputError if it has none, with the stages of which it has one, and what is wrong with
///         checkpoints that cannot be read
geometry::StateTree end_of_stage(const std::filesystem::path& folder, const std::string& stage);

/// Whether a scenario says the same as that of a state, but for what is written.
bool is_same_but_for_output(const Scenario& scenario, const geometry::StateTree& state);

/// A simulation of a stage of an earlier run, as it ended.
/// @param scenario  whose later stages are to go on from it: it has the same bodies up to there
/// @throws InputError if it has others
PreparedRun ended_stage(const Scenario& scenario, const Scenario& stage,
                        const geometry::StateTree& state, const HearSetUp& hear = {});

}  // namespace plekton::apps
