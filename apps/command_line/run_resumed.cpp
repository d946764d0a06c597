// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/run_resumed.hpp"

#include "apps/command_line/resumed_run.hpp"
#include "apps/command_line/warnings.hpp"
#include "apps/run/first_rank.hpp"
#include "apps/run/output_folder.hpp"
#include "apps/scenario/problems.hpp"

#include <fmt/format.h>

#include <iostream>
#include <system_error>
#include <vector>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

/// @throws InputError for options of which one needs another, or that contradict each other
void require_sense(const RunArguments& arguments) {
  if (arguments.from.size() > 1)
    throw InputError(
        "--from: with --resume expected one time; a stage and a folder go with a "
        "scenario file");
  if (!arguments.out.empty())
    require_kept("--resume", arguments.resume, arguments.out);
  else if (!arguments.from.empty() || !arguments.to.empty())
    throw InputError(
        "--from and --to compute a part of a run again, with results of its own; give a folder for "
        "them with --out");
}

/// The run as it was left, with what is asked for since.
ResumedRun find_asked(const RunArguments& arguments) {
  const std::vector<std::string> overrides = overrides_of(arguments.scenario);
  return find_resumed_run({arguments.resume, overrides,
                           arguments.from.empty() ? "" : arguments.from[0], arguments.to,
                           arguments.out.empty()});
}

}  // namespace

int run_resumed(const RunArguments& arguments) {
  const auto began = Progress::Clock::now();
  require_sense(arguments);
  ResumedRun resumed = find_asked(arguments);
  if (!arguments.until.empty() && !resumed.scenario.stage)
    throw InputError(fmt::format(
        "--until {}: the run in {} has no [[stages]], which it names; --to ends at a time",
        arguments.until, arguments.resume.string()));
  const FoundCheckpoint& checkpoint = resumed.checkpoint;
  share_among(arguments.ranks, resumed.scenario);
  const bool same_folder = arguments.out.empty();
  if (!same_folder)
    by_first_rank(arguments.ranks,
                  [&] { check_output_folder(arguments.out, arguments.overwrite); });
  print_warnings(warnings_about(resumed), std::cerr);
  if (!arguments.quiet)
    std::cout << fmt::format("{}: goes on at {:.6g} s, step {}\n", checkpoint.file.string(),
                             time_of(checkpoint.state), steps_of(checkpoint.state));
  const Resumption from{checkpoint.state, same_folder, resumed.from, false,
                        is_by_clock(checkpoint.file)};
  try {
    return run_aloud(arguments, resumed.scenario,
                     {same_folder ? arguments.resume : arguments.out, began, &from, resumed.until});
  } catch (const geometry::StateMismatch& error) {
    throw InputError(
        fmt::format("{}: {}; nothing was changed: the meshes and tables that the scenario names "
                    "have to be as they were",
                    checkpoint.file.string(), error.what()));
  }
}

void require_kept(const std::string& option, const fs::path& folder, const fs::path& out) {
  std::error_code ignored;
  if (!fs::equivalent(folder, out, ignored)) return;
  throw InputError(
      fmt::format("{}: {} is to be kept; give another folder for the results with --out", option,
                  folder.string()));
}

}  // namespace plekton::apps
