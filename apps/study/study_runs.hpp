// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/study/run_key.hpp"
#include "apps/study/study.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace plekton::apps {

/// One run of a study: what it is called, and where it is.
struct PlannedRun {
  std::size_t point = 0;               ///< in the study, from 0
  std::vector<std::string> overrides;  ///< "path=value" each
  std::string key;                     ///< empty where the scenario cannot be run
  std::string problem;                 ///< why not
};

/// The runs of a study and what there is of them in its folder: `runs/KEY` for each, and
/// `runs/KEY.log` with what it said. Runs with the same key are one.
class StudyRuns {
 public:
  /// @param out  Folder of the study. @throws InputError if the scenario cannot be read
  StudyRuns(Study study, std::filesystem::path out);

  const Study& study() const noexcept { return study_; }
  const std::filesystem::path& out() const noexcept { return out_; }
  std::size_t size() const noexcept { return study_.points.size(); }

  /// Reads the scenario with the values of a point; what is wrong with it is its problem.
  PlannedRun plan(std::size_t point);
  /// All of them. @throws InputError if none of them can be run, with the problem of the first
  std::vector<PlannedRun> plan_all();

  std::filesystem::path folder_of(const PlannedRun& run) const;
  std::filesystem::path log_of(const PlannedRun& run) const;

  /// Whether its results are there, of a run that came to its end, of this build and this very
  /// scenario.
  bool is_complete(const PlannedRun& run);

 private:
  Study study_;
  std::filesystem::path out_;
  std::string text_;  ///< of the scenario
  RunKeys keys_;
};

}  // namespace plekton::apps
