// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/repair/repair.hpp"

#include <filesystem>
#include <optional>
#include <ostream>

namespace plekton::apps {

/// What `plekton import` is asked to do.
struct ImportArguments {
  std::filesystem::path mesh;
  geometry::RepairOptions repair;
  double scale = 1.0;                        ///< of the coordinates in the file
  std::optional<double> thickness;           ///< m, to hear whether it goes with the mesh
  std::optional<std::filesystem::path> out;  ///< folder for the repaired mesh and report.json
  bool overwrite = false;  ///< replace these where they are from an earlier import
  bool json = false;       ///< print the report as JSON
};

/// Imports a mesh, prints the report, and writes the repaired mesh (<name>-repaired.off) and
/// report.json if a folder is named.
/// @throws geometry::MeshError if the mesh cannot be used, dynamics::OutputError if the folder
/// cannot be written or holds files of these names that are not to be replaced.
void import_mesh_file(const ImportArguments& arguments, std::ostream& out);

}  // namespace plekton::apps
