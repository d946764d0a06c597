// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

#include <string_view>

namespace plekton::geometry {

/// Requires that a mesh is of a size whose products are numbers, and that its coordinates tell a
/// length from their rounding: far from the origin they do not, and a new mesh of that detail would
/// have no area, or no end.
/// @param length  m, the smallest that a new mesh has to resolve; what is no length is left to others
/// @param what    as in "a wrap of 0.1 m"
/// @throws MeshError
void require_resolved(const Mesh& mesh, double length, std::string_view what);

}  // namespace plekton::geometry
