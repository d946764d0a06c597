// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/export_ondem_command.hpp"

#include "apps/command_line/exit_code.hpp"
#include "apps/command_line/resumed_run.hpp"
#include "apps/command_line/warnings.hpp"
#include "apps/run/other_file.hpp"
#include "apps/run/stage_change.hpp"
#include "apps/takeover/ondem_export.hpp"
#include "dynamics/ondem/write_ondem.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

namespace plekton::apps {
namespace {

/// What `plekton export-ondem` was asked for.
struct ExportOndemArguments {
  std::filesystem::path run;  ///< folder of a run
  std::string at;             ///< a time; empty: that of the last checkpoint
  std::filesystem::path out;  ///< empty: ondem.vtkhdf in the folder
};

dynamics::OndemScene scene_in(const FoundCheckpoint& checkpoint) {
  const ResumedRun run = resumed_from(checkpoint, {});
  const geometry::StateTree& state = checkpoint.state;
  const Scenario& scenario =
      run.scenario.stage ? run.scenario.stages.at(stage_of(state).bodies.stage) : run.scenario;
  PreparedRun prepared = scenario.stage ? prepare_stage(scenario, state) : prepare_run(scenario);
  prepared.simulation->restore(state);
  return ondem_scene_of(scenario, prepared, state);
}

/// @param found  checkpoint that is not after the step of that time
void require_there(const ExportOndemArguments& arguments, double at,
                   const geometry::StateTree& found) {
  constexpr double kRounding = 1e-9;
  if (at > time_of(found) * (1.0 + kRounding) && is_of_last_checkpoint(arguments.run, found))
    refuse_beyond_last("--at", arguments.at, time_of(found));
}

std::string summary_of(const dynamics::OndemScene& scene) {
  const auto clumps =
      std::ranges::count(scene.bodies, dynamics::OndemShape::clump, &dynamics::OndemBody::shape);
  std::string text =
      fmt::format("{} spheres", static_cast<std::ptrdiff_t>(scene.bodies.size()) - clumps);
  const auto add = [&](auto count, const char* what) {
    if (count > 0) text += fmt::format(", {} {}", count, what);
  };
  add(clumps, "clumps");
  add(scene.membranes.size(), "membranes and surfaces of rigid bodies");
  add(scene.planes.size(), "planes");
  add(scene.contact_lines.size(), "contacts");
  return text + fmt::format(" at {:.6g} s, step {}", scene.time, scene.iteration);
}

/// Writes what a checkpoint of a run holds as a file of the ON-DEM network.
/// @param problems  told of later checkpoints that are damaged
/// @throws InputError, dynamics::OutputError
void export_ondem(const ExportOndemArguments& arguments, std::ostream& out,
                  std::ostream& problems) {
  const std::filesystem::path file =
      arguments.out.empty() ? arguments.run / kOndemFile : arguments.out;
  if (file.extension() != ".vtkhdf")
    throw InputError(fmt::format(
        "--out: got \"{}\"; expected a file that ends in .vtkhdf, by which ParaView knows it",
        file.string()));
  refuse_other_file(file, "ON-DEM file of plekton export-ondem", is_ondem);
  const std::optional<double> at = time_option("--at", arguments.at);
  const FoundCheckpoint checkpoint = last_checkpoint(arguments.run, at);
  print_warnings(warnings_about(checkpoint), problems);
  if (at) require_there(arguments, *at, checkpoint.state);
  const dynamics::OndemScene scene = scene_in(checkpoint);
  dynamics::write_ondem(file, scene);
  out << fmt::format("wrote {}: {}\n", file.string(), summary_of(scene));
}

}  // namespace

ProgramCommand add_export_ondem(CLI::App& app) {
  const auto arguments = std::make_shared<ExportOndemArguments>();
  CLI::App* command = app.add_subcommand(
      "export-ondem",
      "Write what a checkpoint of a run holds as an ON-DEM file (VTKHDF), for other codes");
  command->add_option("run", arguments->run, "Folder that plekton run wrote to")->required();
  command->add_option("--at", arguments->at,
                      "Time, as in \"20 ms\", of the checkpoint of its step or else the last one "
                      "before it; the last one of all if not given");
  command->add_option("--out", arguments->out,
                      "File to write, .vtkhdf; ondem.vtkhdf in that folder if not given");
  return {command, [arguments] {
            export_ondem(*arguments, std::cout, std::cerr);
            flush_output();
            return kDone;
          }};
}

}  // namespace plekton::apps
