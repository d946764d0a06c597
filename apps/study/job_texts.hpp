// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace plekton::apps {

/// What others need to make the runs of a study.
struct JobSettings {
  std::filesystem::path program;  ///< plekton; paths are absolute
  std::filesystem::path study;
  std::filesystem::path out;
  int threads = 1;
};

/// A line for a shell for each run, for `parallel` or `sh`.
/// @param runs  positions, from 0
std::string parallel_lines(const JobSettings& settings, std::span<const std::size_t> runs);

/// A script for `sbatch`: an array of jobs with a task for each run.
std::string slurm_script(const JobSettings& settings, std::span<const std::size_t> runs);

}  // namespace plekton::apps
