// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/study/study.hpp"

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps {

/// A result that a run does not have. The message names it and says why.
struct NoResult : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A result whose name is that of no column of its file. The file may be one that some runs have.
struct UnknownResult : NoResult {
  using NoResult::NoResult;
};

/// Why no run can have a result of this name, as far as that is known before any; empty: one may.
/// @param path  in run.json, as in "timing.steps"
std::string problem_with_report(std::string_view path);
/// @param file  a history; only of energy.csv and of measures the columns are known
std::string problem_with_column(const std::string& file, const std::string& column);
/// @param file  in the folder of a run, as in "reactions.csv" or "measures/NAME.csv"
std::string problem_with_file(const std::string& file);

/// One number, or text of run.json, of a run.
struct RunResult {
  std::string text;  ///< as it goes into a table
  std::string unit;  ///< of a column; empty where there is none
};

/// The results of a run that has ended, from its folder, in the order of the settings.
/// @throws NoResult, UnknownResult
std::vector<RunResult> results_of(const std::filesystem::path& folder,
                                  std::span<const ResultSettings> settings);

}  // namespace plekton::apps
