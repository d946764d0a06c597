// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/frames.hpp"
#include "apps/run/initial_contacts.hpp"
#include "apps/run/progress.hpp"
#include "apps/run/run_report.hpp"
#include "apps/scenario/scenario.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>

namespace plekton::apps {

/// A simulation that is ready to run, and what was built for it.
struct PreparedRun {
  BuiltScene built;  ///< its scene has moved into the simulation
  std::unique_ptr<dynamics::Simulation> simulation;
  double duration = 0.0;  ///< s
  InitialContacts start;
  StageBodies bodies;  ///< of a stage; empty: the scenario has none
};

/// The parts of that: a simulation of what was built, and its time step.
std::unique_ptr<dynamics::Simulation> simulation_of(const Scenario& scenario, BuiltScene& built);
/// @throws InputError for more steps than a run may have
/// @param name      what messages call the time
/// @param duration  s
/// @param step      s
void require_possible_duration(const char* name, double duration, double step);
/// @throws InputError as prepare_run()
void choose_time_step(const Scenario& scenario, dynamics::Simulation& simulation);

/// Builds the scene of a scenario and a simulation of it.
/// A chosen time step stays as it is where it is longer than the duration.
/// @throws InputError also for a time step that is not below kLargestStep of the critical one,
/// which it names, or longer than the duration, and for more steps than a run can take.
/// @param hear  told what is being set up, if given
PreparedRun prepare_run(const Scenario& scenario, const HearSetUp& hear = {});

/// From where a run goes on.
struct Resumption {
  const geometry::StateTree& state;
  bool same_folder = true;     ///< whose files go on; or others begin
  std::optional<double> from;  ///< s, when output begins; nothing: goes on as it would have
  bool is_there = false;  ///< the simulation is in that state already: a stage before led to it
  bool by_clock = false;  ///< the state is that of a checkpoint that does not stay
};

/// How and where to run.
struct RunSettings {
  std::filesystem::path out;  ///< folder for all that is written
  std::ostream& progress;
  ProgressStyle style;
  std::function<bool()> is_interrupted;  ///< asked after every step
  /// When the work on the scenario began, for the start-up time of the report.
  Progress::Clock::time_point began = Progress::Clock::now();
  bool overwrite = false;  ///< replace the results of an earlier run
  const Resumption* resume = nullptr;
  const RunReport* stages_before = nullptr;     ///< of the same run of the program
  geometry::StateTree* end_of_stage = nullptr;  ///< set to the state at its end, if it is given
  bool has_next_stage = false;                  ///< which will write run.json
  /// s, at which a run or a stage ends with the step that is nearest; nothing: at its own end.
  std::optional<double> until = std::nullopt;
};

/// Runs a prepared simulation to its end, or until it is at rest or interrupted, and writes frames,
/// energy.csv and run.json.
///
/// run.json appears last, also after an interruption and after an error as far as it can be
/// written; before the run an old one is removed. All other files are complete at any moment. With
/// an automatic time step the critical step is looked at again and again and the step made shorter
/// where it has fallen.
///
/// A run that goes on from a checkpoint writes what it would have written without a stop: what was
/// written after the checkpoint is cut off first.
/// @throws InputError with nothing written if bodies begin where they cannot be
/// (require_possible_start), geometry::StateMismatch if the checkpoint is of another scene, dynamics::OutputError if something cannot be written or the folder
/// holds results that are not to be replaced, dynamics::Diverged
RunReport run(const Scenario& scenario, PreparedRun& prepared, const RunSettings& settings);

}  // namespace plekton::apps
