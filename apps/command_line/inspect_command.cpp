// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/inspect_command.hpp"

#include "apps/command_line/exit_code.hpp"
#include "apps/command_line/warnings.hpp"
#include "apps/run/checkpoints.hpp"
#include "apps/run/run_state.hpp"
#include "dynamics/checkpoint/checkpoint_file.hpp"
#include "geometry/base/printable.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

namespace plekton::apps {
namespace {

using geometry::StateArray;
using geometry::StateTree;

/// What `plekton inspect` was asked for.
struct InspectArguments {
  std::filesystem::path checkpoint;  ///< or the folder of a run, whose last one is meant
  bool all = false;                  ///< with a line for each array
};

/// Rows of an array, 0 if it is not there.
std::size_t rows_of(const StateTree& state, const std::string& name) {
  const auto found = state.arrays.find(name);
  return found == state.arrays.end() ? 0 : found->second.rows();
}

/// Of what there is how much: where it stands in a state, and what it is called.
struct Count {
  const char* array;
  std::string_view name;
};
constexpr std::array<Count, 11> kCounts = {{
    {"nodes/position", "nodes"},
    {"elements/cylinders/radius", "cylinders"},
    {"elements/facets/radius", "facets"},
    {"bonds/bonds/energy", "beams and bars"},
    {"sheets/broken", "facets of sheets"},
    {"planes/point", "planes"},
    {"contacts/spheres/touching/gap", "contacts of grains"},
    {"contacts/surfaces/contacts/gap", "contacts of grains with membranes"},
    {"contacts/structures/patches/gap", "contacts of membranes"},
    {"contacts/structures/bonds/gap", "bonds between membranes"},
    {"contacts/planes/touching/gap", "contacts with planes"},
}};

std::string_view kind_of(const StateArray& array) {
  constexpr std::array<std::string_view, 4> kKinds = {"float64", "int64", "int32", "uint8"};
  return kKinds[array.numbers.index()];
}

std::string lines_of_run(const StateTree& state) {
  if (rows_of(state, std::string(kRunGroup) + "/scenario_file") == 0) return "";
  ScenarioText scenario;
  scenario.exchange(geometry::StateArchive::reader(state).group(kRunGroup));
  std::string text = fmt::format("scenario: {}\n", geometry::printable(scenario.file));
  for (const std::string& replaced : scenario.overrides)
    text += fmt::format("  --set {}\n", geometry::printable(replaced));
  return text;
}

FoundCheckpoint checkpoint_at(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) return last_checkpoint(path);
  return {path, dynamics::read_checkpoint(path), {}};
}

std::string text_of_checkpoint(const FoundCheckpoint& checkpoint) {
  const auto& [file, state, damaged] = checkpoint;
  const dynamics::CheckpointWriter writer = dynamics::writer_of_checkpoint(file);
  std::string text = fmt::format("{}: checkpoint of version {}, whole\n",
                                 geometry::printable(file.string()), dynamics::kCheckpointVersion);
  text += fmt::format("written by plekton {}, revision {}\n", geometry::printable(writer.version),
                      geometry::printable(writer.revision));
  text += fmt::format("time {:.9g} s, step {}\n", time_of(state), steps_of(state));
  text += lines_of_run(state);
  for (const Count& count : kCounts) {
    if (const std::size_t rows = rows_of(state, count.array); rows > 0)
      text += fmt::format("{:>9} {}\n", rows, count.name);
  }
  return text + fmt::format("hash of the checkpoint {:016x}\n", state.hash());
}

std::string list_of_arrays(const StateTree& state) {
  std::string text;
  for (const auto& [name, array] : state.arrays)
    text += fmt::format("  {:<52} {:>9} x {:<3} {}\n", geometry::printable(name), array.rows(),
                        array.columns, kind_of(array));
  return text;
}

/// Says what a checkpoint holds: of which run and when, and how much of what.
/// @param problems  told of later checkpoints that are damaged
/// @throws dynamics::CheckpointError, geometry::StateMismatch; InputError of a folder without one
void inspect_checkpoint(const InspectArguments& arguments, std::ostream& out,
                        std::ostream& problems) {
  const FoundCheckpoint checkpoint = checkpoint_at(arguments.checkpoint);
  print_warnings(warnings_about(checkpoint), problems);
  out << text_of_checkpoint(checkpoint);
  if (arguments.all)
    out << "arrays:\n" << list_of_arrays(checkpoint.state);
  else
    out << fmt::format("{} arrays, which --all lists\n", checkpoint.state.arrays.size());
}

}  // namespace

ProgramCommand add_inspect(CLI::App& app) {
  const auto arguments = std::make_shared<InspectArguments>();
  CLI::App* inspect = app.add_subcommand("inspect", "Say what a checkpoint of a run holds");
  inspect
      ->add_option("checkpoint", arguments->checkpoint,
                   "Checkpoint (.h5), or the folder of a run, whose last one is meant")
      ->required();
  inspect->add_flag("--all", arguments->all, "Also list its arrays, with their sizes");
  return {inspect, [arguments] {
            inspect_checkpoint(*arguments, std::cout, std::cerr);
            flush_output();
            return kDone;
          }};
}

}  // namespace plekton::apps
