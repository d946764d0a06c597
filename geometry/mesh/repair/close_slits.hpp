// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace plekton::geometry {

/// Closes slits that facets without area leave when they are dropped.
///
/// Such a facet lies on its longest side; its middle corner b is on the side between the others, a
/// and c. Without it the surface is open along a-b-c, of no width. An edge flip mends that: the
/// facet a-c-d beyond that side becomes a-b-d and b-c-d. Since b is on a-c exactly, no point of the
/// surface moves, and d is not on that line, so both have an area.
///
/// Nothing is done where that would join nothing (no other facet along a-b or b-c), where the
/// longest side has not exactly one facet, or where an edge would get more than two.
/// The first of the two facets takes the place of the old one, the other is appended; both face as
/// that did. n log n for n facets with corners of dropped ones.
/// @param dropped  triangles of three different places each, in one line exactly, which are no
///                 facets of the mesh
/// @returns how many flips were made
std::size_t close_slits(Mesh& mesh, std::span<const std::array<NodeId, 3>> dropped);

}  // namespace plekton::geometry
