// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line.hpp"

#include "apps/import_command.hpp"
#include "apps/interrupt.hpp"
#include "apps/run.hpp"
#include "apps/scenario_reader.hpp"
#include "apps/summary.hpp"
#include "apps/units.hpp"
#include "geometry/version.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <string>
#include <vector>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

/// What the command line says; the parts of the commands that are not given stay empty.
struct CommandLine {
  fs::path scenario;
  std::vector<std::string> overrides;
  std::optional<int> threads;
  fs::path out;
  fs::path mesh;
  std::string weld = "0 m";
  std::string thickness;
  bool json = false;
};

Scenario scenario_of(const CommandLine& line) {
  std::vector<std::string> overrides = line.overrides;
  if (line.threads) overrides.push_back(fmt::format("simulation.threads={}", *line.threads));
  return read_scenario(line.scenario, overrides);
}

int run_command(const CommandLine& line) {
  const Scenario scenario = scenario_of(line);
  PreparedRun prepared = prepare_run(scenario);
  const fs::path out = line.out.empty() ? fs::path("out") / line.scenario.stem() : line.out;
  std::cout << summary_of(prepared) << std::flush;

  const InterruptGuard guard;
  const bool terminal = ::isatty(STDOUT_FILENO) != 0;
  const RunSettings settings{out, line.overrides, std::cout,
                             terminal ? ProgressStyle::one_line : ProgressStyle::lines,
                             [&] { return guard.interrupted(); }};
  const RunReport report = run(scenario, prepared, settings);
  std::cout << summary_of(report) << "wrote " << out.string()
            << ": run.json, energy.csv, and for ParaView grains.pvd, membranes.pvd, contacts.pvd\n";
  return report.status == RunStatus::interrupted ? kInterrupted : kDone;
}

int check_command(const CommandLine& line) {
  const Scenario scenario = scenario_of(line);
  const PreparedRun prepared = prepare_run(scenario);
  std::cout << summary_of(prepared) << line.scenario.string() << ": no problems\n";
  return kDone;
}

/// A length of the command line.
double length_option(const std::string& name, const std::string& text) {
  try {
    return parse_quantity(text, kLength);
  } catch (const UnitError& error) {
    throw InputError(fmt::format("{}: {}", name, error.what()));
  }
}

int import_command(const CommandLine& line) {
  ImportArguments arguments;
  arguments.mesh = line.mesh;
  arguments.weld = length_option("--weld", line.weld);
  if (!line.thickness.empty()) arguments.thickness = length_option("--thickness", line.thickness);
  if (!line.out.empty()) arguments.out = line.out;
  arguments.json = line.json;
  import_mesh_file(arguments, std::cout);
  return kDone;
}

void add_scenario_options(CLI::App& command, CommandLine& line) {
  command
      .add_option("scenario", line.scenario,
                  "Scenario file (.toml); apps/scenario.md documents its keys")
      ->required();
  command
      .add_option("--set", line.overrides,
                  "Replace a value: path=value, as in simulation.duration=\"1 s\"; may be repeated")
      ->allow_extra_args(false);
  command.add_option("--threads", line.threads, "Threads; the result does not depend on it")
      ->check(CLI::Range(1, 1024));
}

/// One problem after the name of the program, several below it.
void print_error(const std::string& text) {
  const auto more = std::count(text.begin(), text.end(), '\n');
  if (more > 0) {
    std::cerr << fmt::format("plekton: {} problems\n{}\n", more + 1, text);
  } else {
    std::cerr << "plekton: " << text << '\n';
  }
}

int dispatch(int argc, const char* const* argv) {
  CommandLine line;
  CLI::App app("Plekton: discrete elements with deformable structures", "plekton");
  app.set_version_flag("--version", std::string(kVersion));
  app.require_subcommand(1);

  CLI::App* run = app.add_subcommand("run", "Run a scenario");
  add_scenario_options(*run, line);
  run->add_option("--out", line.out,
                  "Folder for the results; out/<name of the scenario> if not given");
  CLI::App* check = app.add_subcommand(
      "check", "Read a scenario, build its scene, and say what it is or what is wrong with it");
  add_scenario_options(*check, line);
  CLI::App* import = app.add_subcommand(
      "import", "Read and repair a mesh (.off, .obj, .stl, .ply, .msh, .vtp), and report on it");
  import->add_option("mesh", line.mesh, "Mesh file")->required();
  import->add_option("--weld", line.weld, "Join points within this distance, as in \"1 um\"");
  import->add_option("--thickness", line.thickness,
                     "Say whether a membrane of this thickness goes with the mesh");
  import->add_option("--out", line.out, "Folder for the repaired mesh and report.json");
  import->add_flag("--json", line.json, "Print the report as JSON");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kUsage;
  }
  if (run->parsed()) return run_command(line);
  return check->parsed() ? check_command(line) : import_command(line);
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  try {
    return dispatch(argc, argv);
  } catch (const std::bad_alloc&) {
    std::cerr << "plekton: out of memory; ask for fewer grains or a coarser mesh\n";
  } catch (const std::exception& error) {
    print_error(error.what());
  }
  return kFailed;
}

}  // namespace plekton::apps
