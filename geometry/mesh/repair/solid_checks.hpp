// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace plekton::geometry {

/// Pairs of facets that meet elsewhere than in the nodes and the edge they share, lower facet
/// first, ascending. Decided exactly (CGAL predicates) on the shared complex, so parts that are
/// joined at a node or along an edge with many facets do not count as intersecting. Facets must
/// have an area and be distinct. n log n + pairs of boxes that overlap.
std::vector<std::array<std::uint32_t, 2>> self_intersections(const Mesh& mesh);

/// Does the surface separate an inside from an outside with every part facing outward (CGAL)? No
/// value for a mesh of which CGAL cannot answer it: not closed, not manifold, or not consistently
/// oriented. It must not intersect itself.
std::optional<bool> bounds_volume(const Mesh& mesh);

}  // namespace plekton::geometry
