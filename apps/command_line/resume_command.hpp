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
  std::optional<double> from;  ///< s, from when on results are wanted
};

/// Finds the last checkpoint of a run, and the scenario that was run.
/// @param overrides  "path=value" each: of [output], [stop], the duration and the threads
/// @param from, to   "0.1 s", of an interval to be computed again, the later one with a checkpoint
///                   before; empty: from the last checkpoint to the end
/// @throws InputError for an override of anything else, which would make it another run
ResumedRun find_resumed_run(const std::filesystem::path& folder,
                            std::span<const std::string> overrides, const std::string& from,
                            const std::string& to);

/// A run that goes on from a checkpoint. @throws InputError as find_resumed_run()
ResumedRun resumed_from(FoundCheckpoint checkpoint, std::span<const std::string> overrides);

/// A time of the command line (s), nothing for an empty one. @throws InputError
std::optional<double> time_option(const char* name, const std::string& text);

}  // namespace plekton::apps
