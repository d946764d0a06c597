// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/repair/report.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace plekton::geometry {

/// Writes verdict and reasons from everything else in the report.
/// @param uncut_polygons  Positions of polygons that could not be cut into triangles; any of them
///        refuses the mesh.
/// @param refusals  Other reasons that refuse it.
void judge(MeshReport& report, std::span<const std::size_t> uncut_polygons,
           std::span<const std::string> refusals);

/// Of a mesh that is scaled after its repair: lengths, areas and volumes as they are then, and the
/// reasons with them. @param factor  > 0
void scale_lengths(MeshReport& report, double factor);

}  // namespace plekton::geometry
