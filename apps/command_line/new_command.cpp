// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/new_command.hpp"

#include "apps/command_line/exit_code.hpp"
#include "apps/programs/shell_word.hpp"
#include "apps/scenario/problems.hpp"
#include "dynamics/output/file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <string_view>

namespace plekton::apps {
namespace {

constexpr std::string_view kScenario =
    R"(# Grains fall on a sheet that hangs at its rim. Change what you like, then: plekton check, plekton run.
# A quantity is a text with a unit, "5 mm", or a plain number in SI units, 0.005.
# plekton list prints every key; plekton schema writes a schema for completion in an editor.

[simulation]
duration = "0.4 s"
# time_step = "1 us"            # chosen during the run if not given
gravity = [0, 0, "-9.81 m/s2"]
damping = 0.1                   # numerical, of a fall too unless damp_gravity = false; 0 for none
# threads = 2                   # the result is the same for any number

# What bodies bring to their contacts.
[materials.stone]
density = "2650 kg/m3"
young_modulus = "50 MPa"        # of the contact: chosen for small overlaps, not that of the solid
friction_angle = "35 deg"

[materials.cloth]
young_modulus = "50 MPa"
friction_angle = "30 deg"

# What two materials do where they touch, if it is not linear_frictional with friction alone.
[[contacts]]
between = "stone"
and = "stone"
restitution = 0.5               # of an impact along the normal

# A membrane: a shape as here, or a mesh file, mesh = "sheet.stl".
[[membranes]]
name = "sheet"
shape = { kind = "sheet", width = "20 cm", length = "20 cm", cells = [10, 10] }
thickness = "2 mm"
sheet_stiffness = "20 kN/m"
areal_mass = "300 g/m2"
material = "cloth"
hold = "rim"

[[grains]]
name = "gravel"
material = "stone"
count = 60
radius = "6 mm"
box = { min = ["-5 cm", "-5 cm", "2 cm"], max = ["5 cm", "5 cm", "8 cm"] }

# [[planes]]                    # a floor
# point = [0, 0, "-20 cm"]
# material = "stone"

[output]
interval = "10 ms"              # between frames

# What the rim bears, in reactions.csv.
[[output.reactions]]
name = "rim"
kind = "support"
membrane = "sheet"
nodes = "rim"
)";

/// Writes a commented scenario to start from to a file that is not there yet, and says what to do
/// with it: grains fall on a sheet that hangs at its rim.
/// @throws InputError
void write_starting_scenario(const std::filesystem::path& file, std::ostream& out) {
  // A single dash is standard input for the commands that read a scenario.
  if (file.filename().empty() || file == "-")
    throw InputError(
        fmt::format("got \"{}\" as the scenario to write; expected a file, as in "
                    "\"scene.toml\"",
                    file.string()));
  if (std::filesystem::exists(file))
    throw InputError(fmt::format("{}: is there already; name a file that is not", file.string()));
  dynamics::OutputFile writer(file);
  writer.write(kScenario);
  writer.commit();
  const std::filesystem::path folder = std::filesystem::path("out") / file.stem();
  out << "wrote " << file.string() << '\n';
  out << fmt::format(
      "check it: plekton check {0}\nrun it:   plekton run {0}\nlook at:  "
      "plekton view {1}\n",
      shell_word(file.string()), shell_word(folder.string()));
}

}  // namespace

ProgramCommand add_new(CLI::App& app) {
  const auto file = std::make_shared<std::filesystem::path>();
  CLI::App* command = app.add_subcommand("new", "Write a commented scenario to start from");
  command->add_option("file", *file, "File to write (.toml)")->required();
  return {command, [file] {
            write_starting_scenario(*file, std::cout);
            flush_output();
            return kDone;
          }};
}

}  // namespace plekton::apps
