// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"
#include "geometry/mesh/repair/report.hpp"

#include <functional>
#include <limits>
#include <string_view>

namespace plekton::geometry {

/// Is told what begins, as in "remeshing", by the thread that repairs.
using HearRepair = std::function<void(std::string_view step)>;

struct RepairOptions {
  /// m. Points that steps of at most this length join become one, chains of them however long, at
  /// the first by x, then y, then z; 0 merges only equal points.
  double weld_distance = 0.0;
  /// Turn facets over so that neighbours agree and closed parts face outward.
  bool orient = true;
  /// Look for facets that intersect each other; they are reported and stay.
  bool find_intersections = true;
  /// Refuse a mesh whose facets still intersect at the end.
  bool refuse_intersections = false;
  /// Fill loops of border edges, of at most 2000 nodes each.
  bool fill_holes = false;
  /// m. Holes of a larger perimeter stay open, as the rim of a sheet should.
  double longest_hole = std::numeric_limits<double>::infinity();
  /// Replace the surface by a closed one around it (see wrap): the last resort.
  bool wrap = false;
  /// m. Details of this size survive the wrap; 0 takes 1/30 of the diagonal of the bounds.
  double wrap_detail = 0.0;
  /// m. Remesh to edges of about this length (see remesh); 0 leaves the facets as they are.
  double target_edge = 0.0;
  /// Told where a repair is, as large meshes take a while; empty: nobody is.
  HearRepair hear = {};

  /// Tells who listens, if anybody does.
  void tell(std::string_view step) const {
    if (hear) hear(step);
  }
};

/// Turns polygons into facets over shared nodes and tells what that took.
///
/// Equal points are merged and near ones welded, polygons cut into triangles, facets dropped that
/// repeat a node, have exactly no area (decided without rounding: a needle stays) or have the nodes
/// of an earlier one, slits that such facets leave closed, neighbours oriented alike, and unused
/// points removed. What is not manifold stays as it is, with its nodes shared. Nodes keep the order
/// of the points and facets that of the polygons; otherwise the outcome depends on neither order,
/// except for ties that find_orientation names. Then, only if asked for, steps follow that change
/// the shape: holes are filled, the surface wrapped, and remeshed.
/// @param report  Its source names the mesh in messages; everything else is written anew. Verdict
///        refused if no facet is left or a polygon cannot be cut (it crosses itself), if a step
///        that was asked for cannot be done, or if facets intersect that must not; the mesh must
///        then not be used.
/// @throws MeshError for points that are not finite, corners that name no point, and a weld
///         distance that is negative, not finite, or below the resolution of the coordinates; also
///         for a longest hole or a wrap detail that is no length.
Mesh repair(const PolygonSoup& soup, const RepairOptions& options, MeshReport& report);

}  // namespace plekton::geometry
