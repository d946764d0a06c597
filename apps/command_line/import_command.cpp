// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/import_command.hpp"

#include "apps/run/output_folder.hpp"
#include "dynamics/output/file.hpp"
#include "geometry/mesh/io/import.hpp"
#include "geometry/mesh/io/mesh_file.hpp"

#include <array>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

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

}  // namespace

void import_mesh_file(const ImportArguments& arguments, std::ostream& out) {
  const std::string mesh_name = arguments.mesh.stem().string() + "-repaired.off";
  if (arguments.out && !arguments.overwrite)
    refuse_results(*arguments.out, "import",
                   std::array<std::string_view, 2>{mesh_name, "report.json"});
  geometry::ImportOptions options;
  options.repair = arguments.repair;
  options.scale = arguments.scale;
  const geometry::ImportedMesh imported = [&]() -> geometry::ImportedMesh {
    if (!arguments.thickness) return geometry::import_mesh(arguments.mesh, options);
    auto with_thickness =
        geometry::import_membrane(arguments.mesh, {*arguments.thickness}, options);
    return {std::move(with_thickness.mesh), std::move(with_thickness.report)};
  }();
  if (arguments.out) write_import(*arguments.out, mesh_name, imported);

  out << (arguments.json ? geometry::to_json(imported.report) : geometry::to_text(imported.report));
  if (arguments.out && !arguments.json) {
    out << "wrote " << (*arguments.out / mesh_name).string() << " and "
        << (*arguments.out / "report.json").string() << '\n';
  }
}

}  // namespace plekton::apps
