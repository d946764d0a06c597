// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"
#include "geometry/mesh/generate/membrane.hpp"
#include "geometry/mesh/repair/report.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace plekton::apps {

/// The geometry of a membrane in its place, before it is in a scene.
struct MembraneBody {
  geometry::Membrane membrane;  ///< without facets for a net
  std::vector<bool> on_rim;     ///< by node: on an edge with one facet, on a side of the
                                ///< rectangle around a net, or at an end of a chain
  std::vector<bool> is_twist;   ///< by edge: wires wound around each other; empty where none is
  double area = 0.0;            ///< m², of the facets, or of the rectangle around a net; no
                                ///< area of a chain
  std::optional<geometry::MeshReport> report;  ///< of the import; nothing for a shape
};

/// Imports the mesh of a membrane or makes its shape, and puts it in its place.
/// @param first_node  Number of its first node in the scene.
/// @throws geometry::MeshError for a mesh or shape that cannot be used.
MembraneBody make_membrane_body(const MembraneSettings& settings, std::size_t first_node);

/// Adds what is doubtful about the geometry of a body, and about the import of its mesh.
void tell_warnings(const std::string& name, const MembraneBody& body,
                   std::vector<std::string>& warnings);

}  // namespace plekton::apps
