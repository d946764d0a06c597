// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/generate/membrane.hpp"
#include "geometry/mesh/mesh.hpp"
#include "geometry/mesh/repair/repair.hpp"
#include "geometry/mesh/repair/report.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace plekton::geometry {

struct ImportOptions {
  RepairOptions repair = {};  ///< lengths after scaling
  double scale = 1.0;         ///< of all coordinates, before anything else; finite, > 0
};

struct ImportedMesh {
  Mesh mesh;
  MeshReport report;
};

/// A mesh whose verdict is refused.
struct RefusedMesh : MeshError {
  RefusedMesh(const std::string& text, std::optional<RepairStep> step)
      : MeshError(text), failed_step(step) {}
  std::optional<RepairStep> failed_step;  ///< as in its report
};

/// Reads a mesh file, repairs it and reports on it.
/// @throws MeshError if the file cannot be read or holds bad numbers (as read_mesh_file), or if the
/// scale is none.
/// @throws RefusedMesh if the verdict is refused.
ImportedMesh import_mesh(const std::filesystem::path& path, const ImportOptions& options = {});

/// The same with polygons from memory.
/// @param source  what messages call them
ImportedMesh import_soup(PolygonSoup soup, const std::string& source,
                         const ImportOptions& options = {});

struct ImportedMembrane {
  Mesh mesh;
  Membrane membrane;
  MeshReport report;  ///< of the mesh, and of what does not go with the thickness
};

/// From a mesh file to a membrane: import_mesh(), then make_membrane(). Where the thickness, the
/// edges and the folds do not fit together the verdict is at best usable with warnings.
/// @throws MeshError as both do.
ImportedMembrane import_membrane(const std::filesystem::path& path, const MembraneOptions& membrane,
                                 const ImportOptions& options = {});

}  // namespace plekton::geometry
