// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"
#include "geometry/mesh/repair/repair.hpp"
#include "geometry/mesh/repair/report.hpp"

#include <string>
#include <vector>

namespace plekton::geometry {

/// The steps of repair that change the shape of a cleaned mesh, as far as the options ask for them:
/// fill holes, wrap, remesh, in this order. Fills in report.reshaped, and report.failed_step if it
/// is refused.
/// @returns Why it is refused; empty if all was done. The mesh is then as far as it came.
std::vector<std::string> reshape(Mesh& mesh, const RepairOptions& options, MeshReport& report);

}  // namespace plekton::geometry
