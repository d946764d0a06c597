// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/remesh.hpp"

#include "geometry/base/elementary.hpp"
#include "geometry/mesh/repair/cgal_mesh.hpp"
#include "geometry/mesh/repair/measures.hpp"
#include "geometry/mesh/repair/resolution.hpp"
#include "geometry/mesh/repair/solid_checks.hpp"

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace plekton::geometry {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

constexpr double kMostRemeshedFacets = 2e7;
constexpr unsigned kRounds = 5;

void require_remeshable(const MeshMeasures& measures, double target_edge) {
  std::ostringstream text;
  // An equilateral facet has the area sqrt(3) / 4 of its squared side.
  const double facets = measures.area / (0.25 * std::sqrt(3.0) * target_edge * target_edge);
  if (!(target_edge > 0.0) || !std::isfinite(target_edge))
    text << "a target edge of " << target_edge << " m; expected a positive length";
  else if (!(facets < kMostRemeshedFacets))
    text << "a target edge of " << target_edge << " m would make about " << facets
         << " facets; expected at most 2e7; use a longer edge";
  else if (measures.many_facet_edges + measures.non_manifold_nodes > 0)
    text << "cannot be remeshed: " << measures.many_facet_edges
         << " edges have more than two facets and " << measures.non_manifold_nodes
         << " nodes join more than one fan, which remeshing would tear apart; remesh the parts "
            "before they are joined, or wrap the surface";
  else if (measures.inconsistent_edges > 0)
    text << "cannot be remeshed: along " << measures.inconsistent_edges
         << " edges the facets disagree; orient the mesh, or cut it there if it has one side only";
  else
    return;
  throw MeshError(text.str());
}

/// @throws MeshError for a facet that names a point twice
void require_three_points_each(const Mesh& mesh) {
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const auto& [a, b, c] = mesh.facets[f];
    if (a != b && b != c && c != a) continue;
    throw MeshError("cannot be remeshed: facet " + std::to_string(f) +
                    " names a point twice; take it out, as repair() does");
  }
}

/// Edges and nodes that remeshing has to respect.
struct Features {
  SurfaceMesh::Property_map<SurfaceMesh::Edge_index, bool> kept;
  SurfaceMesh::Property_map<SurfaceMesh::Vertex_index, bool> fixed;
};

Vec3 way_along(const SurfaceMesh& surface, SurfaceMesh::Halfedge_index halfedge) {
  const auto& from = surface.point(surface.source(halfedge));
  const auto& to = surface.point(surface.target(halfedge));
  return {to.x() - from.x(), to.y() - from.y(), to.z() - from.z()};
}

/// Whether a line of features ends or branches at a node, or turns there as a circle of less than
/// two target edges radius does. Elsewhere a piece of 4/3 of the target is at most a ninth of the
/// target away from the line: (4/3)² / (8 * 2).
bool is_corner(const SurfaceMesh& surface, SurfaceMesh::Vertex_index node, const Features& features,
               double target_edge) {
  std::vector<Vec3> ways;  // to the node
  for (const auto halfedge : CGAL::halfedges_around_target(node, surface))
    if (features.kept[surface.edge(halfedge)]) ways.push_back(way_along(surface, halfedge));
  if (ways.empty()) return false;
  if (ways.size() != 2) return true;
  const double turn = elementary::atan2(ways[0].cross(ways[1]).norm(), -ways[0].dot(ways[1]));
  return turn * 2.0 * target_edge > 0.5 * (ways[0].norm() + ways[1].norm());
}

void mark_lines(SurfaceMesh& surface, Features& features) {
  PMP::detect_sharp_edges(surface, kFeatureAngle, features.kept);
  for (const auto edge : surface.edges())
    if (surface.is_border(edge)) features.kept[edge] = true;
}

/// @param collapse  whether short edges of features go, too
Mesh remeshed(const Mesh& mesh, double target_edge, bool collapse) {
  const CgalSoup soup = to_cgal(mesh);
  SurfaceMesh surface;
  PMP::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, surface);
  Features features{
      surface.add_property_map<SurfaceMesh::Edge_index, bool>("e:kept", false).first,
      surface.add_property_map<SurfaceMesh::Vertex_index, bool>("v:fixed", false).first};
  mark_lines(surface, features);
  std::vector<SurfaceMesh::Edge_index> lines;
  for (const auto edge : surface.edges())
    if (features.kept[edge]) lines.push_back(edge);
  // What is kept must be short enough before, or the rounds would never end.
  PMP::split_long_edges(lines, 4.0 / 3.0 * target_edge, surface);
  mark_lines(surface, features);
  if (collapse) {
    for (const auto node : surface.vertices())
      features.fixed[node] = is_corner(surface, node, features, target_edge);
  }
  PMP::isotropic_remeshing(surface.faces(), target_edge, surface,
                           CGAL::parameters::number_of_iterations(kRounds)
                               .edge_is_constrained_map(features.kept)
                               .vertex_is_constrained_map(features.fixed)
                               .protect_constraints(!collapse)
                               .collapse_constraints(collapse));
  surface.collect_garbage();
  return to_mesh(surface);
}

}  // namespace

Mesh remesh(const Mesh& mesh, double target_edge) {
  require_corners(mesh);
  require_three_points_each(mesh);
  std::ostringstream what;
  what << "a target edge of " << target_edge << " m";
  require_resolved(mesh, target_edge, what.str());
  require_remeshable(measure(mesh, false), target_edge);
  Mesh result = remeshed(mesh, target_edge, true);
  const std::size_t crossings = self_intersections(result).size();
  if (crossings == 0) return result;
  // Lines that lie close together may cross when they are made of fewer pieces.
  Mesh careful = remeshed(mesh, target_edge, false);
  return self_intersections(careful).size() < crossings ? careful : result;
}

}  // namespace plekton::geometry
