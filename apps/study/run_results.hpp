// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/study/study.hpp"

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace plekton::apps {

/// A result that a run does not have. The message names it and says why.
struct NoResult : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One number, or text of run.json, of a run.
struct RunResult {
  std::string text;  ///< as it goes into a table
  std::string unit;  ///< of a column; empty where there is none
};

/// The results of a run that has ended, from its folder, in the order of the settings.
/// @throws NoResult
std::vector<RunResult> results_of(const std::filesystem::path& folder,
                                  std::span<const ResultSettings> settings);

}  // namespace plekton::apps
