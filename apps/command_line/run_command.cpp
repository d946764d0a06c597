// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/run_command.hpp"

#include "apps/command_line/error_text.hpp"
#include "apps/command_line/exit_code.hpp"
#include "apps/command_line/rank_job.hpp"
#include "apps/command_line/run_aloud.hpp"
#include "apps/command_line/run_resumed.hpp"
#include "apps/run/first_rank.hpp"
#include "apps/run/output_folder.hpp"
#include "apps/scenario/problems.hpp"
#include "apps/scenario/toml_file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <exception>
#include <memory>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

fs::path default_folder(const Scenario& scenario) {
  const bool is_input = scenario.file == kStandardInputName;
  return fs::path("out") / (is_input ? fs::path("stdin") : scenario.file.stem());
}

/// @throws InputError for options that only scenarios with stages know, or that contradict others
void require_stages(const RunArguments& arguments, const Scenario& scenario, const fs::path& out) {
  if (arguments.from.empty() && arguments.until.empty()) return;
  if (!scenario.stage)
    throw InputError(fmt::format("{}: has no [[stages]], which --from STAGE DIR and --until name",
                                 scenario.file.string()));
  if (arguments.from.size() == 1)
    throw InputError(
        fmt::format("--from {}: expected the name of a stage and the folder of the run that it is "
                    "of, or --resume with the folder of a run and a time",
                    arguments.from[0]));
  if (arguments.from.size() > 1) require_kept("--from", arguments.from[1], out);
}

int run_asked(const RunArguments& arguments) {
  if (!arguments.resume.empty()) return run_resumed(arguments);
  if (arguments.scenario.file.empty()) {
    print_error("run: expected a scenario file, or --resume with the folder of a run");
    return kUsage;
  }
  const auto began = Progress::Clock::now();
  Scenario scenario = scenario_of(arguments.scenario);
  share_among(arguments.ranks, scenario);
  const fs::path out = arguments.out.empty() ? default_folder(scenario) : arguments.out;
  require_stages(arguments, scenario, out);
  // Before the scene is built, which may take long.
  by_first_rank(arguments.ranks, [&] { check_output_folder(out, arguments.overwrite); });
  return run_aloud(arguments, scenario, {out, began});
}

/// The same on all ranks that were started together.
int run_on_ranks(RunArguments& arguments) {
  RankJob job;
  arguments.ranks = job.ranks();
  if (arguments.ranks == nullptr) return run_asked(arguments);
  try {
    if (arguments.scenario.file == "-" && arguments.ranks->count() > 1)
      throw InputError("run: standard input comes to the first rank alone; name a scenario file");
    return run_asked(arguments);
  } catch (const std::exception& error) {
    print_error(text_of(error));
    job.end_failed(kFailed, text_of(error));
  }
  return kFailed;
}

void add_options(CLI::App& run, RunArguments& arguments) {
  CLI::Option* const to_run = add_scenario_options(run, arguments.scenario);
  CLI::Option* const resume =
      run.add_option("--resume", arguments.resume,
                     "Go on with the run in this folder, from its last checkpoint: with --out in "
                     "another folder")
          ->excludes(to_run);
  run.add_option("--from", arguments.from,
                 "STAGE DIR: go on from the end of a stage of the run in that folder, with the "
                 "later stages of this scenario. Or with --resume and --out a time: compute a part "
                 "of the run again, from there on")
      ->expected(1, 2)
      ->type_name("STAGE DIR");
  run.add_option("--until", arguments.until, "End after this stage");
  run.add_option("--to", arguments.to, "And end at this time")->needs(resume);
  run.add_option("--out", arguments.out,
                 "Folder for the results; out/<name of the scenario> if not given, out/stdin of "
                 "standard input");
  run.add_flag("--overwrite", arguments.overwrite,
               "Replace the results of an earlier run in that folder");
  run.add_flag("--strict", arguments.strict,
               "End with exit code 3 if anything in the certificate of the run is red");
  run.add_flag("--quiet", arguments.quiet,
               "Print nothing but problems and warnings, on standard error");
}

}  // namespace

ProgramCommand add_run(CLI::App& app) {
  const auto arguments = std::make_shared<RunArguments>();
  CLI::App* run = app.add_subcommand("run", "Run a scenario");
  add_options(*run, *arguments);
  return {run, [arguments] { return run_on_ranks(*arguments); }};
}

}  // namespace plekton::apps
