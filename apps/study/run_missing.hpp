// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/study/study_runs.hpp"

#include <filesystem>
#include <functional>
#include <ostream>
#include <vector>

namespace plekton::apps {

/// How runs of a study are made.
struct MakeSettings {
  std::filesystem::path program;  ///< plekton
  int jobs = 1;                   ///< at a time
  int threads = 1;                ///< of each
  std::ostream& progress;         ///< a line for each run that has ended
  std::function<bool()> is_interrupted;
};

/// Makes those runs that are not complete, each by a process of its own. What ended badly gets its
/// problem; the others go on. After an interruption the runs that go on are asked to end; they and
/// those that were not begun have no problem, and are missing. Where the first run that is whole has
/// no result of a name that is asked for, no more are begun.
/// @param runs  whose key is not empty, or that have a problem already
/// @returns which result that is; empty: all runs were begun
/// @throws dynamics::OutputError if nothing can be written to the folder of the study
std::string make_missing(StudyRuns& study, std::vector<PlannedRun>& runs,
                         const MakeSettings& settings);

/// Those that are not complete and could be, each key once; positions among the runs.
std::vector<std::size_t> missing_among(StudyRuns& study, const std::vector<PlannedRun>& runs);

}  // namespace plekton::apps
