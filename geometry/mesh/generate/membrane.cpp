// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/membrane.hpp"

#include "geometry/base/elementary.hpp"
#include "geometry/mesh/edge_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

namespace plekton::geometry {
namespace {

std::optional<std::size_t> repeating_facet(const Mesh& mesh) {
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const auto& [a, b, c] = mesh.facets[f];
    if (a == b || b == c || c == a) return f;
  }
  return std::nullopt;
}

void require_usable(const Mesh& mesh, const MembraneOptions& options) {
  constexpr auto kMostNodes = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  require_corners(mesh);
  std::ostringstream text;
  if (!(options.thickness > 0.0) || !std::isfinite(options.thickness))
    text << "a membrane of thickness " << options.thickness << " m; expected a positive length";
  else if (mesh.facets.empty())
    text << "a membrane of a mesh without facets; expected at least one";
  else if (options.first_node > kMostNodes || mesh.points.size() > kMostNodes - options.first_node)
    text << "a membrane of " << mesh.points.size() << " nodes from number " << options.first_node
         << " on; the numbers of nodes end at 2147483647";
  else if (const auto facet = repeating_facet(mesh))
    text << "a membrane of a mesh whose facet " << *facet
         << " repeats a node; merge duplicate nodes or leave out the facet";
  else
    return;
  throw MeshError(text.str());
}

void warn_about_edges(const Mesh& mesh, const EdgeTable& edges, double thickness,
                      std::vector<std::string>& warnings) {
  double shortest = std::numeric_limits<double>::infinity();
  std::size_t short_edges = 0;
  for (const auto& [a, b] : edges.edges()) {
    const double length = (mesh.points[index_of(b)] - mesh.points[index_of(a)]).norm();
    shortest = std::min(shortest, length);
    if (length < thickness) ++short_edges;
  }
  if (short_edges == 0) return;
  std::ostringstream text;
  text << "the thickness of " << thickness << " m exceeds the length of " << short_edges << " of "
       << edges.size() << " edges (shortest " << shortest
       << " m); use longer edges or a thinner membrane";
  warnings.push_back(text.str());
}

/// Radius of the sphere through two facets hinged at their common edge, from the fold angle and the
/// facet heights.
double fold_radius(const Mesh& mesh, const std::array<NodeId, 2>& edge, NodeId far_a,
                   NodeId far_b) {
  const Vec3& x0 = mesh.points[index_of(edge[0])];
  const Vec3 along = (mesh.points[index_of(edge[1])] - x0).stableNormalized();
  const auto height_of = [&](NodeId far) {
    const Vec3 d = mesh.points[index_of(far)] - x0;
    return Vec3(d - d.dot(along) * along);
  };
  const Vec3 a = height_of(far_a), b = height_of(far_b);
  // The fold angle is the angle between one height and the continuation of the other; the sheet
  // turns by it within half the height of either facet.
  const double fold = elementary::atan2(a.cross(b).norm(), -a.dot(b));
  return fold > 0.0 ? 0.5 * (a.norm() + b.norm()) / fold : std::numeric_limits<double>::infinity();
}

NodeId far_node(const std::array<NodeId, 3>& facet, const std::array<NodeId, 2>& edge) {
  return *std::find_if(facet.begin(), facet.end(),
                       [&](NodeId n) { return n != edge[0] && n != edge[1]; });
}

void warn_about_folds(const Mesh& mesh, const EdgeTable& edges, double thickness,
                      std::vector<std::string>& warnings) {
  double sharpest = std::numeric_limits<double>::infinity();
  std::size_t sharp_folds = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto uses = edges.uses(e);
    if (uses.size() != 2) continue;
    const auto& edge = edges.edges()[e];
    const double radius = fold_radius(mesh, edge, far_node(mesh.facets[uses[0].facet], edge),
                                      far_node(mesh.facets[uses[1].facet], edge));
    sharpest = std::min(sharpest, radius);
    if (radius < 0.5 * thickness) ++sharp_folds;
  }
  if (sharp_folds == 0) return;
  std::ostringstream text;
  text << "half the thickness of " << thickness << " m exceeds the radius of " << sharp_folds
       << " folds (sharpest " << sharpest
       << " m), where the sheet overlaps itself; use a thinner membrane";
  warnings.push_back(text.str());
}

}  // namespace

Membrane make_membrane(const Mesh& mesh, const MembraneOptions& options) {
  require_usable(mesh, options);
  const EdgeTable edges(mesh);
  const auto in_scene = [&](NodeId node) {
    return id_at<NodeId>(index_of(node) + options.first_node);
  };

  Membrane membrane;
  membrane.nodes = mesh.points;
  membrane.facets.reserve(mesh.facets.size());
  for (const auto& [a, b, c] : mesh.facets)
    membrane.facets.push_back({{in_scene(a), in_scene(b), in_scene(c)}, 0.5 * options.thickness});
  membrane.edges.reserve(edges.size());
  for (const auto& [a, b] : edges.edges()) membrane.edges.push_back({in_scene(a), in_scene(b)});
  warn_about_edges(mesh, edges, options.thickness, membrane.warnings);
  warn_about_folds(mesh, edges, options.thickness, membrane.warnings);
  return membrane;
}

}  // namespace plekton::geometry
