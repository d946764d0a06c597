// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/run_aloud.hpp"

#include "apps/command_line/asked_stages.hpp"
#include "apps/command_line/exit_code.hpp"
#include "apps/command_line/interrupt.hpp"
#include "apps/command_line/set_up_aloud.hpp"
#include "apps/command_line/summary.hpp"
#include "apps/command_line/warnings.hpp"
#include "apps/programs/shell_word.hpp"
#include "apps/run/first_rank.hpp"
#include "apps/run/output_folder.hpp"
#include "apps/run/run_warnings.hpp"

#include <unistd.h>

#include <iostream>
#include <string_view>
#include <utility>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

/// What a run has written to its folder.
std::string files_in(const fs::path& folder) {
  std::string files;
  std::string_view before_series = ", and for ParaView ";
  for (const std::string_view name : kResultFiles) {
    if (!has_results(folder, name)) continue;
    if (name.ends_with(".pvd")) {
      files += std::exchange(before_series, ", ");
    } else if (!files.empty()) {
      files += ", ";
    }
    files += name;
  }
  return files;
}

/// Says how a run has ended. @returns the exit code
int conclude(const RunArguments& arguments, const fs::path& out, const RunReport& report) {
  if (arguments.quiet) {
    print_warnings(report.warnings, std::cerr);
  } else {
    std::cout << summary_of(report) << "wrote " << out.string() << ": " << files_in(out) << '\n'
              << "look at it: plekton view " << shell_word(out.string()) << '\n';
  }
  const bool is_refused = arguments.strict && has_red(certificate_of(report));
  if (report.status != RunStatus::interrupted) return is_refused ? kRed : kDone;
  if (!arguments.quiet)
    std::cout << "go on with: plekton run --resume " << shell_word(out.string()) << '\n';
  return kInterrupted;
}

RunSettings settings_of(const RunArguments& arguments, const PartOfRun& part,
                        const InterruptGuard& guard) {
  RunSettings settings{folder_of_rank(arguments.ranks, part.out),
                       std::cout,
                       style_on(STDOUT_FILENO, arguments.quiet),
                       asked_now_and_then(arguments.ranks, [&] { return guard.interrupted(); }),
                       part.began,
                       arguments.overwrite};
  settings.until = part.until;
  return settings;
}

int run_without_stages(const RunArguments& arguments, const Scenario& scenario,
                       const PartOfRun& part) {
  PreparedRun prepared = prepared_aloud(scenario, arguments.quiet);
  if (!arguments.quiet) std::cout << summary_of(scenario, prepared) << std::flush;
  const InterruptGuard guard;
  RunSettings settings = settings_of(arguments, part, guard);
  settings.resume = part.resume;
  return conclude(arguments, part.out, run(scenario, prepared, settings));
}

StagesAsked stages_of(const RunArguments& arguments, const Resumption* resume) {
  StagesAsked asked{resume ? std::vector<std::string>{} : arguments.from, nullptr, arguments.until};
  if (resume != nullptr) {
    asked.resume = &resume->state;
    asked.same_folder = resume->same_folder;
    asked.by_clock = resume->by_clock;
    asked.written_from = resume->from;
  }
  return asked;
}

int run_with_stages(const RunArguments& arguments, const Scenario& scenario,
                    const PartOfRun& part) {
  const InterruptGuard guard;
  const RunSettings settings = settings_of(arguments, part, guard);
  const auto run_them = [&](const HearSetUp& hear) {
    return run_stages_asked(scenario, stages_of(arguments, part.resume), settings, hear,
                            arguments.quiet ? nullptr : &std::cout);
  };
  return conclude(arguments, part.out, aloud(arguments.quiet, run_them));
}

}  // namespace

int run_aloud(const RunArguments& arguments, const Scenario& scenario, const PartOfRun& part) {
  return scenario.stage ? run_with_stages(arguments, scenario, part)
                        : run_without_stages(arguments, scenario, part);
}

}  // namespace plekton::apps
