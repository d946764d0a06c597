// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/study/job_texts.hpp"

#include "apps/programs/shell_word.hpp"

#include <fmt/format.h>

#include <cctype>

namespace plekton::apps {
namespace {

/// All but the number of the run, which comes last. The program looks again whether the run is
/// there when the line is carried out, so that no run is made twice.
std::string command(const JobSettings& settings) {
  return fmt::format("{} study {} --out {} --threads {} --only", shell_word(settings.program),
                     shell_word(settings.study), shell_word(settings.out), settings.threads);
}

/// Numbers from 1, as in "1-3,7".
std::string ranges_of(std::span<const std::size_t> runs) {
  std::string text;
  for (std::size_t i = 0; i < runs.size();) {
    std::size_t end = i + 1;
    while (end < runs.size() && runs[end] == runs[end - 1] + 1) ++end;
    if (!text.empty()) text += ',';
    text += std::to_string(runs[i] + 1);
    if (end - i > 1) text += fmt::format("-{}", runs[end - 1] + 1);
    i = end;
  }
  return text;
}

/// Letters, digits, - and _ of a name: a line that Slurm reads has no quoting that is sure.
std::string plain(const std::string& name) {
  std::string text;
  for (const char c : name)
    text += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' ? c : '_';
  return text;
}

}  // namespace

std::string parallel_lines(const JobSettings& settings, std::span<const std::size_t> runs) {
  std::string text;
  for (const std::size_t run : runs) text += fmt::format("{} {}\n", command(settings), run + 1);
  return text;
}

std::string slurm_script(const JobSettings& settings, std::span<const std::size_t> runs) {
  return fmt::format(
      "#!/bin/sh\n"
      "#SBATCH --job-name={}\n"
      "#SBATCH --array={}\n"
      "#SBATCH --cpus-per-task={}\n"
      "exec {} \"$SLURM_ARRAY_TASK_ID\"\n",
      plain(settings.study.stem().string()), ranges_of(runs), settings.threads, command(settings));
}

}  // namespace plekton::apps
