// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/edge_table.hpp"
#include "geometry/mesh/mesh.hpp"
#include "geometry/primitives/box.hpp"

#include <cstddef>
#include <optional>

namespace plekton::geometry {

/// What a mesh is like. Lengths in m, areas in m², volumes in m³.
struct MeshMeasures {
  std::size_t points = 0;
  std::size_t facets = 0;
  std::size_t edges = 0;
  std::size_t border_edges = 0;        ///< with one facet
  std::size_t many_facet_edges = 0;    ///< with more than two
  std::size_t inconsistent_edges = 0;  ///< with two that run along it in the same direction
  std::size_t non_manifold_nodes =
      0;                       ///< whose facets form neither a disc nor a half disc around them
  std::size_t components = 0;  ///< parts that share no node
  std::size_t non_orientable_patches = 0;
  long long euler_characteristic = 0;  ///< points - edges + facets
  bool closed = false;                 ///< no border edge (and at least one facet)
  double area = 0.0;
  std::optional<double> volume;  ///< only of a closed mesh whose facets agree
  std::optional<bool>
      bounds_volume;  ///< whether it parts an inside from an outside, every part facing outward;
  ///< only of a closed mesh that does not intersect itself, and if CGAL can tell
  std::optional<std::size_t> self_intersections;  ///< pairs of facets; no value if not asked for
  double smallest_angle = 0.0;                    ///< degrees
  double shortest_edge = 0.0;
  double mean_edge = 0.0;
  double longest_edge = 0.0;
  Box bounds = {Vec3::Zero(), Vec3::Zero()};  ///< of all points, not rounded
};

/// Measures a mesh; an empty one has zeros. All points are counted, whether a facet uses them or
/// not.
/// Lengths are right from 1e-150 m on, areas of facets from 1e-300 m²; a volume below 1e-308 m³
/// vanishes.
/// @param intersections  Look for facets that intersect, by far the most expensive part; facets have
///                       to have an area for that, which is not checked.
/// @throws MeshError for facets that name a point which is not there
MeshMeasures measure(const Mesh& mesh, bool intersections);

/// Degrees, of all corners of facets; 0 without facets. @throws as measure()
double smallest_angle(const Mesh& mesh);
/// Degrees; facets with smaller ones are needles.
inline constexpr double kSmallAngle = 1.0;

}  // namespace plekton::geometry
