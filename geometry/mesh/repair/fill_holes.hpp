// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

#include <cstddef>

namespace plekton::geometry {

struct FilledHoles {
  std::size_t filled = 0;  ///< loops of border edges that are closed now
  std::size_t facets = 0;  ///< new ones
  std::size_t left = 0;    ///< loops within the length that could not be filled, and nodes at which
                           ///< a border branches
};

/// Loops with more nodes than this are left open, because the search for the best filling may take
/// time with the cube of their number.
inline constexpr std::size_t kLargestHole = 2000;

/// Fills holes with facets over the nodes of their rims; no node is added or moved. A hole is a
/// loop of edges with one facet each, so the outer rim of an open sheet is one as well. The filling
/// is the one of CGAL's triangulate_hole_polyline (smallest largest fold, then smallest area, over
/// a Delaunay triangulation) and faces as its neighbours do. A loop is left open if it passes a
/// node where more than two border edges meet, if neighbours along it disagree in orientation, if
/// it has more than kLargestHole nodes, or if every filling found would repeat a facet, give an
/// existing edge another facet, or have facets without area.
/// @param longest  m. Only loops of at most this length; infinite for all.
/// Source: Liepa, Filling holes in meshes (2003); Zou, Ju & Carr, An algorithm for triangulating
/// multiple 3D polygons (2013).
FilledHoles fill_holes(Mesh& mesh, double longest);

}  // namespace plekton::geometry
