// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/import_command.hpp"

#include "apps/command_line/exit_code.hpp"
#include "apps/command_line/set_up_aloud.hpp"
#include "apps/run/output_folder.hpp"
#include "apps/scenario/problems.hpp"
#include "apps/scenario/units.hpp"
#include "apps/scenario/value_type.hpp"
#include "dynamics/output/file.hpp"
#include "geometry/base/printable.hpp"
#include "geometry/mesh/io/import.hpp"
#include "geometry/mesh/io/mesh_file.hpp"
#include "geometry/mesh/repair/repair.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

/// What `plekton import` was asked for; lengths and numbers as they are given.
struct ImportArguments {
  fs::path mesh;
  std::string scale = "1";  ///< of the coordinates in the file
  std::string weld = "0 m";
  bool fill_holes = false;
  std::optional<std::string> longest_hole;
  bool wrap = false;
  std::optional<std::string> wrap_detail;
  std::optional<std::string> target_edge;
  bool refuse_intersections = false;
  std::optional<std::string> thickness;  ///< to hear whether it goes with the mesh
  fs::path out;            ///< folder for the repaired mesh and report.json; empty: none
  bool overwrite = false;  ///< replace these where they are from an earlier import
  bool json = false;       ///< print the report as JSON
};

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

geometry::RepairOptions repair_options(const ImportArguments& arguments) {
  geometry::RepairOptions options;
  options.weld_distance = length_option("--weld", arguments.weld, kNotNegative);
  options.fill_holes = arguments.fill_holes || arguments.longest_hole;
  if (arguments.longest_hole)
    options.longest_hole = length_option("--longest-hole", *arguments.longest_hole, kPositive);
  options.wrap = arguments.wrap || arguments.wrap_detail;
  if (arguments.wrap_detail)
    options.wrap_detail = length_option("--wrap-detail", *arguments.wrap_detail, kPositive);
  if (arguments.target_edge)
    options.target_edge = length_option("--target-edge", *arguments.target_edge, kPositive);
  options.refuse_intersections = arguments.refuse_intersections;
  return options;
}

void write_import(const fs::path& folder, const fs::path& mesh_name,
                  const geometry::ImportedMesh& imported) {
  make_output_folder(folder);
  dynamics::OutputFile mesh(folder / mesh_name);
  mesh.write(geometry::format_mesh(imported.mesh, geometry::MeshFormat::off));
  dynamics::OutputFile report(folder / "report.json");
  report.write(geometry::to_json(imported.report));
  mesh.commit();
  report.commit();
}

/// @param thickness  m, of a membrane; nothing: it is no membrane
geometry::ImportedMesh imported_mesh(const fs::path& mesh, const geometry::ImportOptions& options,
                                     const std::optional<double>& thickness) {
  if (!thickness) return geometry::import_mesh(mesh, options);
  auto with_thickness = geometry::import_membrane(mesh, {*thickness}, options);
  return {std::move(with_thickness.mesh), std::move(with_thickness.report)};
}

/// Imports a mesh, prints the report, and writes the repaired mesh (<name>-repaired.off) and
/// report.json if a folder is named.
/// @throws geometry::MeshError if the mesh cannot be used, dynamics::OutputError if the folder
/// cannot be written or holds files of these names that are not to be replaced.
void import_mesh_file(const ImportArguments& arguments, std::ostream& out) {
  geometry::ImportOptions options;
  options.scale = scale_option(arguments.scale);
  options.repair = repair_options(arguments);
  std::optional<double> thickness;
  if (arguments.thickness)
    thickness = length_option("--thickness", *arguments.thickness, kPositive);
  const std::string mesh_name = arguments.mesh.stem().string() + "-repaired.off";
  const bool is_written = !arguments.out.empty();
  if (is_written && !arguments.overwrite)
    refuse_results(arguments.out, "import",
                   std::array<std::string_view, 2>{mesh_name, "report.json"});
  const auto import = [&](const HearSetUp& hear) {
    options.repair.hear = [&](std::string_view step) { hear(std::string(step), 0.0); };
    return imported_mesh(arguments.mesh, options, thickness);
  };
  const geometry::ImportedMesh imported =
      aloud(false, import, "importing " + geometry::printable(arguments.mesh.filename().string()));
  if (is_written) write_import(arguments.out, mesh_name, imported);

  out << (arguments.json ? geometry::to_json(imported.report) : geometry::to_text(imported.report));
  if (is_written && !arguments.json) {
    out << "wrote " << (arguments.out / mesh_name).string() << " and "
        << (arguments.out / "report.json").string() << '\n';
  }
}

void add_options(CLI::App& import, ImportArguments& arguments) {
  import.add_option("mesh", arguments.mesh, "Mesh file")->required();
  import.add_option("--scale", arguments.scale,
                    "Multiply all coordinates by this first, as in 0.001 for a mesh in mm");
  import.add_option("--weld", arguments.weld, "Join points within this distance, as in \"1 um\"");
  import.add_flag("--fill-holes", arguments.fill_holes,
                  "Fill holes, also the rim of an open sheet");
  import.add_option("--longest-hole", arguments.longest_hole,
                    "Fill only holes of at most this perimeter");
  import.add_option("--target-edge", arguments.target_edge, "Remesh to edges of about this length");
  import.add_flag("--wrap", arguments.wrap,
                  "Replace the surface by a closed one around it, as the last resort");
  import.add_option("--wrap-detail", arguments.wrap_detail,
                    "Size of the details a wrap keeps; 1/30 of the size if not given");
  import.add_flag("--refuse-intersections", arguments.refuse_intersections,
                  "Refuse a mesh whose facets still intersect at the end");
  import.add_option("--thickness", arguments.thickness,
                    "Say whether a membrane of this thickness goes with the mesh");
  import.add_option("--out", arguments.out, "Folder for the repaired mesh and report.json");
  import.add_flag("--overwrite", arguments.overwrite,
                  "Replace the files of an earlier import in that folder");
  import.add_flag("--json", arguments.json, "Print the report as JSON");
}

}  // namespace

ProgramCommand add_import(CLI::App& app) {
  const auto arguments = std::make_shared<ImportArguments>();
  CLI::App* import = app.add_subcommand(
      "import", "Read and repair a mesh (.off, .obj, .stl, .ply, .msh, .vtp), and report on it");
  add_options(*import, *arguments);
  return {import, [arguments] {
            import_mesh_file(*arguments, std::cout);
            flush_output();
            return kDone;
          }};
}

}  // namespace plekton::apps
