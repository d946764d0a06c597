// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/largest_coordinate.hpp"
#include "geometry/base/types.hpp"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace plekton::geometry {

/// Triangles over shared nodes. Any number of facets may meet at an edge or a node, and they share
/// it: a node is never duplicated to make a surface manifold, because what is joined must stay
/// joined when it deforms.
struct Mesh {
  std::vector<Vec3> points;  ///< m, indexed by NodeId
  std::vector<std::array<NodeId, 3>>
      facets;  ///< counterclockwise seen from outside, where there is an outside
};

/// Polygons as a file lists them, before any repair: corners may repeat, points may coincide or be
/// unused.
struct PolygonSoup {
  std::vector<Vec3> points;                        ///< m
  std::vector<std::vector<std::size_t>> polygons;  ///< corners as positions in points
  std::size_t skipped_elements = 0;  ///< points, lines and solids of the file: no part of a surface
};

/// A mesh that cannot be read, written or used. The message names the file, the place, what was
/// found, what was expected and a way out; all problems of a file come in one message. What it
/// quotes of a file may be any bytes: control characters come out as in "\\n" and "\\x1b".
struct MeshError : std::runtime_error {
  explicit MeshError(const std::string& text);
};

/// What takes a mesh from outside asks this first.
/// @throws MeshError naming the first facets with a corner that is none of the points
void require_corners(const Mesh& mesh);

/// The same triangles as polygons.
PolygonSoup to_soup(const Mesh& mesh);

}  // namespace plekton::geometry
