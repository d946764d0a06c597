// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/import_yade_command.hpp"

#include "apps/command_line/exit_code.hpp"
#include "apps/run/initial_contacts.hpp"
#include "apps/run/output_folder.hpp"
#include "apps/run/run.hpp"
#include "apps/scenario/problems.hpp"
#include "apps/scenario/scenario_reader.hpp"
#include "apps/takeover/run_yade.hpp"
#include "apps/takeover/scenario_text.hpp"
#include "dynamics/output/file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

/// What `plekton import-yade` was asked for.
struct ImportYadeArguments {
  fs::path script;
  std::string iteration = "0";  ///< to run to, or end: where the script ends
  fs::path out;                 ///< folder; empty: out/<script>-yade
  bool overwrite = false;
};

/// What is wrong with a scenario as it stands; empty if nothing is.
std::string problem_of(const std::string& text, const fs::path& file) {
  try {
    const Scenario scenario = parse_scenario(text, file);
    require_possible_start(prepare_run(scenario).start, scenario);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

/// Tried with YADE's time step, and with one that is chosen where that is refused.
yade::Takeover tried(const yade::Scene& scene, const fs::path& script, const fs::path& file) {
  yade::TakeoverOptions options;
  options.script = script.filename().string();
  yade::Takeover takeover = yade::take_over(scene, options);
  std::string problem = problem_of(takeover.scenario, file);
  if (problem.find("simulation.time_step:") != std::string::npos) {
    const std::string refused = problem;
    options.has_chosen_step = true;
    takeover = yade::take_over(scene, options);
    takeover.notes.push_back(
        fmt::format("YADE's time step is refused, so one is chosen: {}", refused));
    problem = problem_of(takeover.scenario, file);
  }
  if (!problem.empty())
    takeover.notes.push_back(fmt::format("plekton refuses the scenario as it stands: {}", problem));
  return takeover;
}

std::string report_of(const yade::Takeover& takeover, const yade::Scene& scene,
                      const fs::path& script) {
  std::string text = fmt::format("{} at iteration {}, {:.6g} s, time step {:.6g} s\n",
                                 script.string(), scene.iteration, scene.time, scene.time_step);
  text += "taken over:\n";
  for (const std::string& line : takeover.counts) text += fmt::format("  {}\n", line);
  if (takeover.counts.empty()) text += "  nothing\n";
  text += "not as in YADE:\n";
  for (const std::string& line : takeover.notes) text += fmt::format("  {}\n", line);
  if (takeover.notes.empty()) text += "  nothing that is known of\n";
  return text;
}

/// Nothing for the end of the script.
std::optional<long> iteration_of(const std::string& text) {
  if (text == "end") return std::nullopt;
  long iteration = -1;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, iteration);
  if (read.ec != std::errc() || read.ptr != end || iteration < 0)
    throw InputError(fmt::format(
        "--iteration: got {}; expected at least 0, or end for where the script ends", text));
  return iteration;
}

/// Runs a script of YADE to an iteration and writes what is there as a scenario, with a report of
/// what has no counterpart; prints the report. The scenario is tried: where YADE's time step is no
/// step here, it gets one that is chosen, and what else is wrong with it is reported.
/// @throws InputError, dynamics::OutputError
void import_yade(const ImportYadeArguments& arguments, std::ostream& out) {
  const std::optional<long> iteration = iteration_of(arguments.iteration);
  const std::string stem = arguments.script.stem().string();
  const fs::path folder =
      arguments.out.empty() ? fs::path("out") / (stem + "-yade") : arguments.out;
  const std::string scenario_name = stem + ".toml";
  if (!arguments.overwrite)
    refuse_results(folder, "import-yade",
                   std::array<std::string_view, 2>{scenario_name, "report.txt"});
  const yade::Scene scene = yade::run_to(arguments.script, iteration);
  const yade::Takeover takeover = tried(scene, arguments.script, folder / scenario_name);
  if (takeover.counts.empty())
    throw InputError(
        fmt::format("{}: at iteration {} there are no bodies that could be taken over; "
                    "does the script make them later?",
                    arguments.script.string(), scene.iteration));
  make_output_folder(folder);
  dynamics::OutputFile scenario(folder / scenario_name);
  scenario.write(takeover.scenario);
  dynamics::OutputFile report(folder / "report.txt");
  const std::string text = report_of(takeover, scene, arguments.script);
  report.write(text);
  scenario.commit();
  report.commit();
  out << text
      << fmt::format("wrote {} and {}\n", (folder / scenario_name).string(),
                     (folder / "report.txt").string());
}

}  // namespace

ProgramCommand add_import_yade(CLI::App& app) {
  const auto arguments = std::make_shared<ImportYadeArguments>();
  CLI::App* command = app.add_subcommand(
      "import-yade", "Run a script of YADE to an iteration, and write what is there as a scenario");
  command->add_option("script", arguments->script, "Script of YADE (.py)")->required();
  command
      ->add_option("--iteration", arguments->iteration,
                   "To run to; 0 is what the script makes, end where it ends")
      ->capture_default_str();
  command->add_option("--out", arguments->out,
                      "Folder for the scenario and report.txt; out/<script>-yade if not given");
  command->add_flag("--overwrite", arguments->overwrite,
                    "Replace the files of an earlier import in that folder");
  return {command, [arguments] {
            import_yade(*arguments, std::cout);
            flush_output();
            return kDone;
          }};
}

}  // namespace plekton::apps
