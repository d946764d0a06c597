// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <ostream>

namespace plekton::apps {

/// What `plekton study` is to do about runs that are missing.
struct StudyArguments {
  std::filesystem::path study;
  std::filesystem::path out;        ///< empty: out/<name of the study>
  std::optional<int> jobs;          ///< instead of that of the study
  std::optional<int> threads;       ///< likewise
  bool parallel = false;            ///< print a line for each
  bool slurm = false;               ///< print a script
  bool collect = false;             ///< only write the table
  std::optional<std::size_t> only;  ///< make this one alone (from 1), and no table
  bool quiet = false;
};

/// @returns an ExitCode: kFailed if a run failed or, where only is collected, is missing
/// @throws InputError, dynamics::OutputError
int study_runs(const StudyArguments& arguments, std::ostream& out);

}  // namespace plekton::apps
