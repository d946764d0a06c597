// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/study/study_runs.hpp"

#include <filesystem>
#include <vector>

namespace plekton::apps {

/// How many runs of a study there are, and how they are.
struct StudyCount {
  std::size_t all = 0;
  std::size_t complete = 0;
  std::size_t failed = 0;   ///< with a problem
  std::size_t missing = 0;  ///< not made yet, or interrupted
};

/// Writes results.csv into the folder of a study, complete or not at all: a row for each run with
/// its number, values and results, its status (complete, failed or missing), what was wrong, and its
/// key. A run whose results cannot be had has failed. @throws dynamics::OutputError
StudyCount write_study_table(StudyRuns& study, std::vector<PlannedRun>& runs);

/// Refuses a folder in which another table has that name. @throws InputError
void refuse_other_table(const std::filesystem::path& folder);

inline constexpr const char* kStudyTable = "results.csv";

}  // namespace plekton::apps
