// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/checkpoints.hpp"
#include "apps/scenario/scenario.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plekton::apps {

/// A run that goes on.
struct ResumedRun {
  FoundCheckpoint checkpoint;
  Scenario scenario;
  std::optional<double> from;   ///< s, from when on results are wanted
  std::optional<double> until;  ///< s, up to when
};

/// A run that is to go on.
struct ResumeArguments {
  std::filesystem::path folder;  ///< of the run
  /// "path=value" each: of [output], [stop], the duration and the threads
  std::span<const std::string> overrides;
  /// "0.1 s", of an interval to be computed again, the earlier one with a checkpoint before; empty:
  /// from the last checkpoint to the end
  std::string from = "", to = "";
  bool same_folder = false;  ///< its histories go on: they have to be there
};

/// Finds the last checkpoint of a run, and the scenario that was run.
/// @throws InputError for an override of anything else, which would make it another run
ResumedRun find_resumed_run(const ResumeArguments& arguments);

/// What whoever goes on with it has to know: checkpoints that had to be left, and that another
/// revision of the program wrote the one that is taken.
std::vector<std::string> warnings_about(const ResumedRun& run);

/// A run that goes on from a checkpoint. @throws InputError as find_resumed_run()
ResumedRun resumed_from(FoundCheckpoint checkpoint, std::span<const std::string> overrides);

/// A time of the command line (s), nothing for an empty one. @throws InputError
std::optional<double> time_option(const char* name, const std::string& text);

/// Whether no checkpoint of a run is later. @param state  of one of them
bool is_of_last_checkpoint(const std::filesystem::path& run, const geometry::StateTree& state);

/// Refuses a time of the command line that is after the last checkpoint of a run.
/// @param last  s, the time of that
[[noreturn]] void refuse_beyond_last(const char* option, const std::string& got, double last);

}  // namespace plekton::apps
