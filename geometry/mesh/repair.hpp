// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"
#include "geometry/mesh/report.hpp"

namespace plekton::geometry {

struct RepairOptions {
  /// m. Points within this distance of each other become one; 0 merges only equal points.
  double weld_distance = 0.0;
  /// Turn facets over so that neighbours agree and closed parts face outward.
  bool orient = true;
  /// Look for facets that intersect each other (only reported, never changed).
  bool find_intersections = true;
};

/// Turns polygons into facets over shared nodes and tells what that took.
///
/// Equal points are merged and near ones welded, polygons cut into triangles, facets dropped that
/// repeat a node, have exactly no area (decided without rounding: a needle stays) or have the nodes
/// of an earlier one, neighbours oriented alike, and unused points removed. What is not manifold
/// stays as it is, with its nodes shared. Nodes keep the order of the points and facets that of the
/// polygons; otherwise the outcome depends on
/// neither order, except for ties that find_orientation names.
/// @param report  Its source names the mesh in messages; everything else is written anew. Verdict
///        refused if no facet is left or a polygon cannot be cut (it crosses itself); the mesh must
///        then not be used.
/// @throws MeshError for points that are not finite, corners that name no point, and a weld
///         distance that is negative, not finite, or below the resolution of the coordinates.
Mesh repair(const PolygonSoup& soup, const RepairOptions& options, MeshReport& report);

}  // namespace plekton::geometry
