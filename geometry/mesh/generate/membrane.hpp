// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"
#include "geometry/primitives/facet.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace plekton::geometry {

struct MembraneOptions {
  double thickness;  ///< m
  std::size_t first_node =
      0;  ///< number that the first point of the mesh gets among the nodes of the scene
};

/// A mesh as a thick sheet: what to append to the nodes and elements of a scene.
struct Membrane {
  std::vector<Vec3> nodes;    ///< m, the points of the mesh
  std::vector<Facet> facets;  ///< radius = thickness / 2
  std::vector<std::array<NodeId, 2>>
      edges;  ///< every edge once, lower node first, ascending: where bonds go
  std::vector<std::string> warnings;  ///< thickness and facets that do not fit together
};

/// Thickens a mesh. Facets and edges name the nodes by their numbers in the scene.
/// @throws MeshError if the thickness is not a positive length, the mesh has no facet or one that
///         repeats a node or names a point which is not there, or the numbers of the nodes do not
///         fit a NodeId.
Membrane make_membrane(const Mesh& mesh, const MembraneOptions& options);

}  // namespace plekton::geometry
