// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/command_line.hpp"

#include "apps/command_line/check_report.hpp"
#include "apps/command_line/examples_command.hpp"
#include "apps/command_line/export_ondem_command.hpp"
#include "apps/command_line/generate_command.hpp"
#include "apps/command_line/import_command.hpp"
#include "apps/command_line/import_yade_command.hpp"
#include "apps/command_line/inspect_command.hpp"
#include "apps/command_line/interrupt.hpp"
#include "apps/command_line/list_command.hpp"
#include "apps/command_line/new_command.hpp"
#include "apps/command_line/plot_command.hpp"
#include "apps/command_line/rank_job.hpp"
#include "apps/command_line/render_command.hpp"
#include "apps/command_line/resume_command.hpp"
#include "apps/command_line/run_estimate.hpp"
#include "apps/command_line/stages_command.hpp"
#include "apps/command_line/start_listing.hpp"
#include "apps/command_line/step_advice.hpp"
#include "apps/command_line/study_command.hpp"
#include "apps/command_line/summary.hpp"
#include "apps/command_line/usage_error.hpp"
#include "apps/command_line/validate_command.hpp"
#include "apps/command_line/verify_command.hpp"
#include "apps/command_line/view_command.hpp"
#include "apps/command_line/warnings.hpp"
#include "apps/programs/shell_word.hpp"
#include "apps/run/first_rank.hpp"
#include "apps/run/output_folder.hpp"
#include "apps/run/run.hpp"
#include "apps/run/run_warnings.hpp"
#include "apps/scenario/json_schema.hpp"
#include "apps/scenario/scenario_reader.hpp"
#include "apps/scenario/section.hpp"
#include "apps/scenario/toml_file.hpp"
#include "apps/scenario/units.hpp"
#include "geometry/base/printable.hpp"
#include "geometry/version.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

/// The command that is not in the help.
constexpr std::string_view kGenerate = "generate";

/// What the command line says; the parts of the commands that are not given stay empty.
struct CommandLine {
  fs::path scenario;
  std::vector<std::string> overrides;
  std::optional<int> threads;
  fs::path out;
  fs::path mesh;
  std::string scale = "1";
  std::string weld = "0 m";
  bool fill_holes = false;
  std::optional<std::string> longest_hole;
  bool wrap = false;
  std::optional<std::string> wrap_detail;
  std::optional<std::string> target_edge;
  bool refuse_intersections = false;
  std::optional<std::string> thickness;
  bool overwrite = false;
  bool quiet = false;
  bool strict = false;
  bool json = false;
  bool power_iteration = false;
  fs::path resume;
  fs::path checkpoint;
  bool all = false;
  std::vector<std::string> from;
  std::string until;
  std::vector<std::string> interval;
  std::string to;
  fs::path run;
  double limit = ViewArguments{}.limit;
  std::optional<std::string> serve;
  StudyArguments study;
  ImportYadeArguments yade;
  std::vector<std::string> columns;
  std::string x;
  std::string at;
  ValidateArguments validate;
  std::string example;
  fs::path new_file;
  GenerateArguments generated;
  geometry::Ranks* ranks = nullptr;  ///< that compute a run together; nothing: this process
};

/// With the threads that are asked for.
std::vector<std::string> overrides_of(const CommandLine& line) {
  std::vector<std::string> overrides = line.overrides;
  if (line.threads) overrides.push_back(fmt::format("simulation.threads={}", *line.threads));
  return overrides;
}

Scenario scenario_of(const CommandLine& line) {
  return read_scenario(line.scenario, overrides_of(line));
}

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

/// For commands whose result is what they print. @throws InputError if it has not arrived
void flush_output() {
  if (std::cout.flush()) return;
  throw InputError(
      fmt::format("standard output: cannot be written: {}; what is missing there is "
                  "lost, repeat the command",
                  std::generic_category().message(errno)));
}

/// How to tell a progress there.
ProgressStyle style_on(int descriptor, bool quiet) {
  if (quiet) return ProgressStyle::none;
  return ::isatty(descriptor) != 0 ? ProgressStyle::one_line : ProgressStyle::lines;
}

/// Says on standard error what is being set up, so that results stay alone on standard output.
/// @param set_up  (hear), what is done meanwhile
template <class SetUp>
auto aloud(bool quiet, SetUp&& set_up) {
  SetUpProgress progress(std::cerr, style_on(STDERR_FILENO, quiet));
  return set_up([&](const std::string& what, double share) { progress.update(what, share); });
}

PreparedRun prepared_aloud(const Scenario& scenario, bool quiet) {
  return aloud(quiet, [&](const HearSetUp& hear) { return prepare_run(scenario, hear); });
}

fs::path default_folder(const Scenario& scenario) {
  const bool is_input = scenario.file == kStandardInputName;
  return fs::path("out") / (is_input ? fs::path("stdin") : scenario.file.stem());
}

/// One problem after the name of the program, several below it. A line that begins with a blank
/// goes on with the problem before it.
void print_error(const std::string& text) {
  std::istringstream lines(text);
  std::string shown;
  int problems = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(' ')) ++problems;
    shown += geometry::printable(line) + '\n';
  }
  std::cerr << "plekton: " << (problems > 1 ? fmt::format("{} problems\n", problems) : "") << shown;
}

const char* text_of(const std::exception& error) {
  const bool is_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
  return is_memory ? "out of memory; ask for fewer grains or a coarser mesh" : error.what();
}

/// Says how a run has ended. @returns the exit code
int conclude(const CommandLine& line, const fs::path& out, const RunReport& report) {
  if (line.quiet) {
    print_warnings(report.warnings, std::cerr);
  } else {
    std::cout << summary_of(report) << "wrote " << out.string() << ": " << files_in(out) << '\n'
              << "look at it: plekton view " << shell_word(out.string()) << '\n';
  }
  const bool is_refused = line.strict && has_red(certificate_of(report));
  if (report.status != RunStatus::interrupted) return is_refused ? kRed : kDone;
  if (!line.quiet)
    std::cout << "go on with: plekton run --resume " << shell_word(out.string()) << '\n';
  return kInterrupted;
}

RunSettings settings_of(const CommandLine& line, const fs::path& out, const InterruptGuard& guard,
                        Progress::Clock::time_point began) {
  return {folder_of_rank(line.ranks, out),
          std::cout,
          style_on(STDOUT_FILENO, line.quiet),
          asked_now_and_then(line.ranks, [&] { return guard.interrupted(); }),
          began,
          line.overwrite};
}

/// Runs a scenario, from its beginning or from a state.
int run_aloud(const CommandLine& line, const Scenario& scenario, const fs::path& out,
              const Resumption* resume, const std::optional<double>& until,
              Progress::Clock::time_point began) {
  PreparedRun prepared = prepared_aloud(scenario, line.quiet);
  if (!line.quiet) std::cout << summary_of(scenario, prepared) << std::flush;
  const InterruptGuard guard;
  RunSettings settings = settings_of(line, out, guard, began);
  settings.resume = resume;
  settings.until = until;
  return conclude(line, out, run(scenario, prepared, settings));
}

/// The same of a scenario with stages.
int run_stages_aloud(const CommandLine& line, const Scenario& scenario, const fs::path& out,
                     const Resumption* resume, const std::optional<double>& until,
                     Progress::Clock::time_point began) {
  const InterruptGuard guard;
  StagesAsked asked{resume ? std::vector<std::string>{} : line.from, nullptr, line.until};
  if (resume != nullptr) {
    asked.resume = &resume->state;
    asked.same_folder = resume->same_folder;
    asked.by_clock = resume->by_clock;
    asked.written_from = resume->from;
  }
  RunSettings settings = settings_of(line, out, guard, began);
  settings.until = until;
  return conclude(line, out, aloud(line.quiet, [&](const HearSetUp& hear) {
                    return run_stages_asked(scenario, asked, settings, hear,
                                            line.quiet ? nullptr : &std::cout);
                  }));
}

/// Refuses to write results over those of the run that they begin from.
/// @param option  that names its folder
void require_kept(const std::string& option, const fs::path& folder, const fs::path& out) {
  std::error_code ignored;
  if (!fs::equivalent(folder, out, ignored)) return;
  throw InputError(
      fmt::format("{}: {} is to be kept; give another folder for the results with --out", option,
                  folder.string()));
}

int resume_command(const CommandLine& line) {
  const auto began = Progress::Clock::now();
  if (line.from.size() > 1)
    throw InputError(
        "--from: with --resume expected one time; a stage and a folder go with a "
        "scenario file");
  const bool same_folder = line.out.empty();
  if (same_folder && !(line.from.empty() && line.to.empty()))
    throw InputError(
        "--from and --to compute a part of a run again, with results of its own; give a folder for "
        "them with --out");
  if (!same_folder) require_kept("--resume", line.resume, line.out);
  const std::vector<std::string> overrides = overrides_of(line);
  ResumedRun resumed = find_resumed_run(
      {line.resume, overrides, line.from.empty() ? "" : line.from[0], line.to, same_folder});
  share_among(line.ranks, resumed.scenario);
  if (!same_folder)
    by_first_rank(line.ranks, [&] { check_output_folder(line.out, line.overwrite); });
  print_warnings(warnings_about(resumed), std::cerr);
  const double time = time_of(resumed.checkpoint.state);
  if (!line.quiet)
    std::cout << fmt::format("{}: goes on at {:.6g} s, step {}\n", resumed.checkpoint.file.string(),
                             time, steps_of(resumed.checkpoint.state));
  const Resumption from{resumed.checkpoint.state, same_folder, resumed.from, false,
                        is_by_clock(resumed.checkpoint.file)};
  const fs::path& out = same_folder ? line.resume : line.out;
  try {
    if (resumed.scenario.stage)
      return run_stages_aloud(line, resumed.scenario, out, &from, resumed.until, began);
    return run_aloud(line, resumed.scenario, out, &from, resumed.until, began);
  } catch (const geometry::StateMismatch& error) {
    throw InputError(
        fmt::format("{}: {}; nothing was changed: the meshes and tables that the scenario names "
                    "have to be as they were",
                    resumed.checkpoint.file.string(), error.what()));
  }
}

/// @throws InputError for options that only scenarios with stages know, or that contradict others
void require_stages(const CommandLine& line, const Scenario& scenario, const fs::path& out) {
  if (line.from.empty() && line.until.empty()) return;
  if (!scenario.stage)
    throw InputError(fmt::format("{}: has no [[stages]], which --from STAGE DIR and --until name",
                                 scenario.file.string()));
  if (line.from.size() == 1)
    throw InputError(
        fmt::format("--from {}: expected the name of a stage and the folder of the run that it is "
                    "of, or --resume with the folder of a run and a time",
                    line.from[0]));
  if (line.from.size() > 1) require_kept("--from", line.from[1], out);
}

int run_command(const CommandLine& line) {
  if (!line.resume.empty()) return resume_command(line);
  if (line.scenario.empty()) {
    print_error("run: expected a scenario file, or --resume with the folder of a run");
    return kUsage;
  }
  const auto began = Progress::Clock::now();
  Scenario scenario = scenario_of(line);
  share_among(line.ranks, scenario);
  const fs::path out = line.out.empty() ? default_folder(scenario) : line.out;
  require_stages(line, scenario, out);
  // Before the scene is built, which may take long.
  by_first_rank(line.ranks, [&] { check_output_folder(out, line.overwrite); });
  if (scenario.stage) return run_stages_aloud(line, scenario, out, nullptr, std::nullopt, began);
  return run_aloud(line, scenario, out, nullptr, std::nullopt, began);
}

/// The same on all ranks that were started together.
int run_on_ranks(CommandLine& line) {
  RankJob job;
  line.ranks = job.ranks();
  if (line.ranks == nullptr) return run_command(line);
  try {
    if (line.scenario == "-")
      throw InputError("run: standard input comes to the first rank alone; name a scenario file");
    return run_command(line);
  } catch (const std::exception& error) {
    print_error(text_of(error));
    job.end_failed(kFailed, text_of(error));
  }
  return kFailed;
}

/// Prints one JSON object, also of a scenario with problems, before these go the way of all errors.
int check_for_programs(const CommandLine& line) {
  const auto print = [](const nlohmann::ordered_json& report) {
    // A path need not be UTF-8; what is not becomes a replacement character.
    std::cout << report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
              << '\n';
    flush_output();
  };
  try {
    const Scenario scenario = scenario_of(line);
    PreparedRun prepared = prepared_aloud(scenario, true);
    require_possible_start(prepared.start, scenario);
    StagesSeen stages;
    if (scenario.stage) stages = look_at_stages(scenario, {});
    auto report = check_report(scenario, prepared);
    for (const std::string& warning : stages.warnings) report["warnings"].push_back(warning);
    print(report);
  } catch (const InputError& error) {
    print(check_report(error.what()));
    throw;
  }
  return kDone;
}

int check_command(const CommandLine& line) {
  if (line.json) return check_for_programs(line);
  const Scenario scenario = scenario_of(line);
  PreparedRun prepared = prepared_aloud(scenario, false);
  std::cout << summary_of(scenario, prepared) << listing_of_start(scenario, prepared) << std::flush;
  require_possible_start(prepared.start, scenario);
  std::cout << step_advice(scenario, prepared);
  if (line.power_iteration) std::cout << summary_of(prepared.simulation->exact_critical_step());
  // Last, since it moves the simulation on.
  std::cout << text_of(estimate_run(scenario, prepared));
  if (scenario.stage) {
    const StagesSeen stages = look_at_stages(scenario, {});
    std::cout << stages.text;
    for (const std::string& warning : stages.warnings) std::cout << "warning: " << warning << '\n';
  }
  std::cout << scenario.file.string() << ": no problems\n";
  flush_output();
  return kDone;
}

/// A length of the command line. @throws InputError for anything else or out of range
double length_option(const std::string& name, const std::string& text, const Range& range) {
  double length = 0.0;
  try {
    length = parse_quantity(text, kLength);
  } catch (const UnitError& error) {
    throw InputError(fmt::format("{}: {}", name, error.what()));
  }
  if (!range.holds(length))
    throw InputError(fmt::format("{}: got \"{}\"; expected a length{}", name, text, range.text));
  return length;
}

/// @throws InputError for what is no positive number
double scale_option(const std::string& text) {
  double scale = 0.0;
  try {
    scale = parse_quantity(text, kNumber);
  } catch (const UnitError& error) {
    throw InputError(fmt::format("--scale: {}", error.what()));
  }
  if (!kPositive.holds(scale))
    throw InputError(
        fmt::format("--scale: got \"{}\"; expected a number{}, such as 0.001 for a "
                    "mesh in mm",
                    text, kPositive.text));
  return scale;
}

geometry::RepairOptions repair_options(const CommandLine& line) {
  geometry::RepairOptions options;
  options.weld_distance = length_option("--weld", line.weld, kNotNegative);
  options.fill_holes = line.fill_holes || line.longest_hole;
  if (line.longest_hole)
    options.longest_hole = length_option("--longest-hole", *line.longest_hole, kPositive);
  options.wrap = line.wrap || line.wrap_detail;
  if (line.wrap_detail)
    options.wrap_detail = length_option("--wrap-detail", *line.wrap_detail, kPositive);
  if (line.target_edge)
    options.target_edge = length_option("--target-edge", *line.target_edge, kPositive);
  options.refuse_intersections = line.refuse_intersections;
  return options;
}

int list_command() {
  list_choices(std::cout);
  flush_output();
  return kDone;
}

int schema_command() {
  std::cout << scenario_schema().dump(2) << '\n';
  flush_output();
  return kDone;
}

int examples_command(const CommandLine& line) {
  if (line.example.empty() && !line.out.empty())
    throw InputError(fmt::format(
        "--out: got \"{}\" without the name of an example, of which the copy would be; name one, "
        "or list them without --out",
        line.out.string()));
  if (line.example.empty())
    list_examples(std::cout);
  else
    copy_example(line.example, line.out, std::cout);
  flush_output();
  return kDone;
}

int new_command(const CommandLine& line) {
  write_starting_scenario(line.new_file, std::cout);
  flush_output();
  return kDone;
}

int generate_command(const CommandLine& line, const CLI::App& app) {
  generate(line.generated, command_table(app), std::cout);
  flush_output();
  return kDone;
}

int inspect_command(const CommandLine& line) {
  inspect_checkpoint({line.checkpoint, line.all}, std::cout, std::cerr);
  flush_output();
  return kDone;
}

int verify_command(const CommandLine& line) {
  const bool is_same =
      verify_run({line.resume, line.interval, overrides_of(line)}, std::cout, std::cerr);
  flush_output();
  return is_same ? kDone : kFailed;
}

int import_command(const CommandLine& line) {
  ImportArguments arguments;
  arguments.mesh = line.mesh;
  arguments.scale = scale_option(line.scale);
  arguments.repair = repair_options(line);
  if (line.thickness)
    arguments.thickness = length_option("--thickness", *line.thickness, kPositive);
  if (!line.out.empty()) arguments.out = line.out;
  arguments.overwrite = line.overwrite;
  arguments.json = line.json;
  import_mesh_file(arguments, std::cout);
  flush_output();
  return kDone;
}

/// The port of --serve: kPort if only that is said. @throws InputError
int port_option(const std::string& text) {
  constexpr int kPort = 8317;
  if (text.empty()) return kPort;
  int port = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc() || end != text.data() + text.size() || port < 0 || port > 65535)
    throw InputError(fmt::format(
        "--serve: got \"{}\"; expected a port from 1 to 65535, or 0 for any that is free", text));
  return port;
}

int view_command(const CommandLine& line) {
  ViewArguments arguments;
  arguments.run = line.run;
  if (!line.out.empty()) arguments.out = line.out;
  arguments.limit = line.limit;
  if (line.serve) arguments.port = port_option(*line.serve);
  view_run(arguments, std::cout);
  flush_output();
  return kDone;
}

int study_command(const CommandLine& line) {
  StudyArguments arguments = line.study;
  arguments.out = line.out;
  arguments.threads = line.threads;
  arguments.quiet = line.quiet;
  const int code = study_runs(arguments, std::cout);
  flush_output();
  return code;
}

int plot_command(const CommandLine& line) {
  plot_run({line.run, line.columns, line.x, line.out}, std::cout);
  flush_output();
  return kDone;
}

int render_command(const CommandLine& line) {
  render_run({line.run, line.at, line.out}, std::cout);
  flush_output();
  return kDone;
}

int export_ondem_command(const CommandLine& line) {
  export_ondem({line.run, line.at, line.out}, std::cout, std::cerr);
  flush_output();
  return kDone;
}

int import_yade_command(const CommandLine& line) {
  import_yade(line.yade, std::cout);
  flush_output();
  return kDone;
}

int validate_command(const CommandLine& line) {
  const bool is_well = validate(line.validate, std::cout, std::cerr);
  flush_output();
  return is_well ? kDone : kFailed;
}

/// @returns that for the scenario
CLI::Option* add_scenario_options(CLI::App& command, CommandLine& line) {
  CLI::Option* const scenario = command.add_option(
      "scenario", line.scenario,
      "Scenario file (.toml), or - for standard input: the mesh files it names are then "
      "relative to the current folder; apps/scenario.md documents its keys");
  command
      .add_option("--set", line.overrides,
                  "Replace a value: path=value, as in simulation.duration=\"1 s\"; may be repeated")
      ->allow_extra_args(false);
  command.add_option("--threads", line.threads, "Threads; the result does not depend on it")
      ->check(CLI::Range(1, 1024));
  return scenario;
}

// The commands and their options.

CLI::App* add_run(CLI::App& app, CommandLine& line) {
  CLI::App* run = app.add_subcommand("run", "Run a scenario");
  CLI::Option* const to_run = add_scenario_options(*run, line);
  CLI::Option* const resume =
      run->add_option("--resume", line.resume,
                      "Go on with the run in this folder, from its last checkpoint: with --out in "
                      "another folder")
          ->excludes(to_run);
  run->add_option(
         "--from", line.from,
         "STAGE DIR: go on from the end of a stage of the run in that folder, with the "
         "later stages of this scenario. Or with --resume and --out a time: compute a part "
         "of the run again, from there on")
      ->expected(1, 2)
      ->type_name("STAGE DIR");
  run->add_option("--until", line.until, "End after this stage");
  run->add_option("--to", line.to, "And end at this time")->needs(resume);
  run->add_option("--out", line.out,
                  "Folder for the results; out/<name of the scenario> if not given, out/stdin of "
                  "standard input");
  run->add_flag("--overwrite", line.overwrite,
                "Replace the results of an earlier run in that folder");
  run->add_flag("--strict", line.strict,
                "End with exit code 3 if anything in the certificate of the run is red");
  run->add_flag("--quiet", line.quiet,
                "Print nothing but problems and warnings, on standard error");
  return run;
}

CLI::App* add_check(CLI::App& app, CommandLine& line) {
  CLI::App* check = app.add_subcommand(
      "check", "Read a scenario, build its scene, and say what it is or what is wrong with it");
  add_scenario_options(*check, line)->required();
  check
      ->add_flag("--power-iteration", line.power_iteration,
                 "Also find the critical time step of the scene as it is by power iteration on "
                 "its forces; not with --json")
      ->excludes(
          check->add_flag("--json", line.json, "Print all of it as JSON, also the problems"));
  return check;
}

CLI::App* add_import(CLI::App& app, CommandLine& line) {
  CLI::App* import = app.add_subcommand(
      "import", "Read and repair a mesh (.off, .obj, .stl, .ply, .msh, .vtp), and report on it");
  import->add_option("mesh", line.mesh, "Mesh file")->required();
  import->add_option("--scale", line.scale,
                     "Multiply all coordinates by this first, as in 0.001 for a mesh in mm");
  import->add_option("--weld", line.weld, "Join points within this distance, as in \"1 um\"");
  import->add_flag("--fill-holes", line.fill_holes, "Fill holes, also the rim of an open sheet");
  import->add_option("--longest-hole", line.longest_hole,
                     "Fill only holes of at most this perimeter");
  import->add_option("--target-edge", line.target_edge, "Remesh to edges of about this length");
  import->add_flag("--wrap", line.wrap,
                   "Replace the surface by a closed one around it, as the last resort");
  import->add_option("--wrap-detail", line.wrap_detail,
                     "Size of the details a wrap keeps; 1/30 of the size if not given");
  import->add_flag("--refuse-intersections", line.refuse_intersections,
                   "Refuse a mesh whose facets still intersect at the end");
  import->add_option("--thickness", line.thickness,
                     "Say whether a membrane of this thickness goes with the mesh");
  import->add_option("--out", line.out, "Folder for the repaired mesh and report.json");
  import->add_flag("--overwrite", line.overwrite,
                   "Replace the files of an earlier import in that folder");
  import->add_flag("--json", line.json, "Print the report as JSON");
  return import;
}

CLI::App* add_import_yade(CLI::App& app, CommandLine& line) {
  CLI::App* import = app.add_subcommand(
      "import-yade", "Run a script of YADE to an iteration, and write what is there as a scenario");
  import->add_option("script", line.yade.script, "Script of YADE (.py)")->required();
  import
      ->add_option("--iteration", line.yade.iteration,
                   "To run to; 0 is what the script makes, end where it ends")
      ->capture_default_str();
  import->add_option("--out", line.yade.out,
                     "Folder for the scenario and report.txt; out/<script>-yade if not given");
  import->add_flag("--overwrite", line.yade.overwrite,
                   "Replace the files of an earlier import in that folder");
  return import;
}

CLI::App* add_export_ondem(CLI::App& app, CommandLine& line) {
  CLI::App* command = app.add_subcommand(
      "export-ondem",
      "Write what a checkpoint of a run holds as an ON-DEM file (VTKHDF), for other codes");
  command->add_option("run", line.run, "Folder that plekton run wrote to")->required();
  command->add_option("--at", line.at,
                      "Time, as in \"20 ms\", of the checkpoint of its step or else the last one "
                      "before it; the last one of all if not given");
  command->add_option("--out", line.out,
                      "File to write, .vtkhdf; ondem.vtkhdf in that folder if not given");
  return command;
}

CLI::App* add_inspect(CLI::App& app, CommandLine& line) {
  CLI::App* inspect = app.add_subcommand("inspect", "Say what a checkpoint of a run holds");
  inspect
      ->add_option("checkpoint", line.checkpoint,
                   "Checkpoint (.h5), or the folder of a run, whose last one is meant")
      ->required();
  inspect->add_flag("--all", line.all, "Also list its arrays, with their sizes");
  return inspect;
}

CLI::App* add_verify(CLI::App& app, CommandLine& line) {
  CLI::App* verify = app.add_subcommand(
      "verify", "Compute a part of a run again, between two of its checkpoints, and compare bits");
  verify->add_option("run", line.resume, "Folder of the run")->required();
  verify
      ->add_option(
          "--interval", line.interval,
          "Begin and end, as in \"0.1 s\" \"0.2 s\": from the checkpoint of the step of the "
          "begin, or else the last one before it, to that of the end")
      ->expected(2);
  verify->add_option("--threads", line.threads, "Threads; the result does not depend on it")
      ->check(CLI::Range(1, 1024));
  return verify;
}

CLI::App* add_view(CLI::App& app, CommandLine& line) {
  CLI::App* view = app.add_subcommand("view", "Write a page that shows a run in a browser");
  view->add_option("run", line.run, "Folder that plekton run wrote to")->required();
  auto* view_out =
      view->add_option("--out", line.out, "File to write; view.html in that folder if not given");
  view->add_option("--limit", line.limit,
                   "Most data in MB; of more, every second frame is left out, and so on")
      ->check(CLI::Range(0.1, 4000.0))
      ->capture_default_str();
  auto* serve = view->add_option("--serve", line.serve,
                                 "Show it at http://127.0.0.1:PORT instead, to this machine only, "
                                 "and follow it while it runs; port 8317 if not given")
                    ->expected(0, 1)
                    ->type_name("[PORT]")
                    ->excludes(view_out);
  // Without a port nothing would be set.
  view->callback([&line, serve] {
    if (serve->count() > 0 && !line.serve) line.serve = "";
  });
  return view;
}

CLI::App* add_study(CLI::App& app, CommandLine& line) {
  CLI::App* study = app.add_subcommand(
      "study",
      "Make many runs of a scenario, those that are missing, and a table of their results");
  study->add_option("study", line.study.study, "Study (.toml); apps/study.md documents its keys")
      ->required();
  study->add_option("--out", line.out,
                    "Folder for the runs and results.csv; out/<name of the study> if not given");
  study->add_option("--jobs", line.study.jobs, "Runs at a time, instead of `jobs` of the study")
      ->check(CLI::Range(1, 1024));
  study->add_option("--threads", line.threads, "Threads of each, instead of those of the study")
      ->check(CLI::Range(1, 1024));
  CLI::Option* const parallel =
      study->add_flag("--parallel", line.study.parallel,
                      "Make none, but print a line for each, for GNU parallel or sh");
  CLI::Option* const slurm =
      study->add_flag("--slurm", line.study.slurm, "Make none, but print a script for sbatch")
          ->excludes(parallel);
  CLI::Option* const collect = study
                                   ->add_flag("--collect", line.study.collect,
                                              "Make none, but the table of those that are there")
                                   ->excludes(parallel)
                                   ->excludes(slurm);
  study
      ->add_option("--only", line.study.only,
                   "Make this one alone, by its number from 1, if it is missing; no table")
      ->excludes(parallel)
      ->excludes(slurm)
      ->excludes(collect);
  study->add_flag("--quiet", line.quiet, "Print nothing but problems, on standard error");
  return study;
}

CLI::App* add_plot(CLI::App& app, CommandLine& line) {
  CLI::App* plot = app.add_subcommand("plot", "Draw the histories of a run, with gnuplot");
  plot->add_option("run", line.run, "Folder that plekton run wrote to")->required();
  plot->add_option("--columns", line.columns,
                   "Columns of energy.csv, reactions.csv, pressures.csv, rigid_bodies.csv, "
                   "ties.csv, planes.csv and measures/NAME.csv, without their units, with commas "
                   "between them; all that are not 0, and of planes.csv those that change, but "
                   "time_step, if not given");
  plot->add_option(
      "--x", line.x,
      "Column on the horizontal axis, as in --x \"front edge.position_y\", for columns "
      "of the same file; the time if not given");
  plot->add_option(
      "--out", line.out,
      "File to write, .svg or .png; plot.svg and plot.png in that folder if not given");
  return plot;
}

CLI::App* add_render(CLI::App& app, CommandLine& line) {
  CLI::App* render =
      app.add_subcommand("render", "Draw a frame of a run, with pvbatch of ParaView");
  render->add_option("run", line.run, "Folder that plekton run wrote to")->required();
  render->add_option("--at", line.at, "Time, as in \"20 ms\"; the last frame if not given");
  render->add_option("--out", line.out,
                     "File to write, .png; frame.png in that folder if not given");
  return render;
}

CLI::App* add_validate(CLI::App& app, CommandLine& line) {
  CLI::App* validate = app.add_subcommand(
      "validate", "Compare with theory what this program comes to, and write a page about it");
  validate->add_option("names", line.validate.names, "Cases; all if not given");
  validate->add_flag("--list", line.validate.list, "Only say which cases there are");
  validate->add_flag("--full", line.validate.full, "With more elements and steps");
  validate->add_option("--out", line.validate.out, "Folder for validation.html")
      ->capture_default_str();
  return validate;
}

CLI::App* add_examples(CLI::App& app, CommandLine& line) {
  CLI::App* examples =
      app.add_subcommand("examples", "List the examples that are shipped, or copy one");
  examples->add_option("name", line.example, "Of the example to copy; all are listed without it");
  examples->add_option("--out", line.out,
                       "Folder for the copy; that of its name, of a C++ program the current one");
  return examples;
}

CLI::App* add_new(CLI::App& app, CommandLine& line) {
  CLI::App* command = app.add_subcommand("new", "Write a commented scenario to start from");
  command->add_option("file", line.new_file, "File to write (.toml)")->required();
  return command;
}

/// For the build, the documentation and the completion of shells.
CLI::App* add_generate(CLI::App& app, CommandLine& line) {
  CLI::App* generate =
      app.add_subcommand(std::string(kGenerate), "Write parts of the documentation");
  generate->group("");
  generate->add_option("what", line.generated.what, "What to write")
      ->required()
      ->check(CLI::IsMember(generated_kinds()));
  generate->add_option("scenario", line.generated.scenario, "Whose paths, for set-paths");
  generate->add_option("--date", line.generated.date, "Of the manual page, as in 2026-11-23");
  return generate;
}

/// @throws InputError
void require_no_empty_option(const CLI::App& app) {
  for (const CLI::App* const command : app.get_subcommands()) {
    for (const CLI::Option* const option : command->get_options()) {
      const std::vector<std::string>& given = option->results();
      if (option->nonpositional() && std::find(given.begin(), given.end(), "") != given.end())
        throw InputError(
            fmt::format("{}: got an empty text, as of a variable of the shell that is not set; "
                        "leave the option "
                        "out, or give it its value",
                        option->get_name()));
    }
  }
}

int dispatch(int argc, const char* const* argv) {
  CommandLine line;
  CLI::App app("Plekton: discrete elements with deformable structures", "plekton");
  app.set_version_flag("--version", std::string(kVersion));
  app.require_subcommand(1);
  const CLI::App* const run = add_run(app, line);
  const CLI::App* const check = add_check(app, line);
  const CLI::App* const import = add_import(app, line);
  const CLI::App* const import_yade_of = add_import_yade(app, line);
  const CLI::App* const export_ondem_of = add_export_ondem(app, line);
  const CLI::App* const inspect = add_inspect(app, line);
  const CLI::App* const verify = add_verify(app, line);
  const CLI::App* const list =
      app.add_subcommand("list", "Say what a scenario can name, with parameters and defaults");
  const CLI::App* const study = add_study(app, line);
  const CLI::App* const plot = add_plot(app, line);
  const CLI::App* const render = add_render(app, line);
  const CLI::App* const validate = add_validate(app, line);
  const CLI::App* const schema = app.add_subcommand(
      "schema", "Print a JSON Schema of scenarios, for completion and checks in editors");
  const CLI::App* const examples = add_examples(app, line);
  const CLI::App* const start = add_new(app, line);
  const CLI::App* const generated = add_generate(app, line);
  add_view(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // help, version
      app.exit(error);
      flush_output();
      return kDone;
    }
    print_error(usage_error(app, error, argc < 2 ? "" : argv[1]));
    return kUsage;
  }
  require_no_empty_option(app);
  if (run->parsed()) return run_on_ranks(line);
  if (check->parsed()) return check_command(line);
  if (import->parsed()) return import_command(line);
  if (import_yade_of->parsed()) return import_yade_command(line);
  if (export_ondem_of->parsed()) return export_ondem_command(line);
  if (inspect->parsed()) return inspect_command(line);
  if (verify->parsed()) return verify_command(line);
  if (study->parsed()) return study_command(line);
  if (plot->parsed()) return plot_command(line);
  if (render->parsed()) return render_command(line);
  if (validate->parsed()) return validate_command(line);
  if (list->parsed()) return list_command();
  if (schema->parsed()) return schema_command();
  if (examples->parsed()) return examples_command(line);
  if (start->parsed()) return new_command(line);
  return generated->parsed() ? generate_command(line, app) : view_command(line);
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  // A write beyond the limit of file sizes (ulimit -f) is to fail with its message, not to end the
  // program within a line.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return dispatch(argc, argv);
  } catch (const std::exception& error) {
    print_error(text_of(error));
  }
  return kFailed;
}

}  // namespace plekton::apps
