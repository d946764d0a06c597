// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/remesh.hpp"

#include "geometry/mesh/measures.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cmath>
#include <sstream>
#include <vector>

namespace plekton::geometry {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Triangle = std::array<std::size_t, 3>;

constexpr double kMostFacets = 2e7;
constexpr unsigned kRounds = 5;

void require_remeshable(const MeshMeasures& measures, double target_edge) {
  std::ostringstream text;
  // An equilateral facet has the area sqrt(3) / 4 of its squared side.
  const double facets = measures.area / (0.25 * std::sqrt(3.0) * target_edge * target_edge);
  if (!(target_edge > 0.0) || !std::isfinite(target_edge))
    text << "a target edge of " << target_edge << " m; expected a positive length";
  else if (!(facets < kMostFacets))
    text << "a target edge of " << target_edge << " m would make about " << facets
         << " facets; expected at most 2e7; use a longer edge";
  else if (measures.many_facet_edges + measures.non_manifold_nodes > 0)
    text << "cannot be remeshed: " << measures.many_facet_edges
         << " edges have more than two facets and " << measures.non_manifold_nodes
         << " nodes join more than one fan, which remeshing would tear apart; remesh the parts "
            "before they are joined, or wrap the surface";
  else if (measures.inconsistent_edges > 0)
    text << "cannot be remeshed: along " << measures.inconsistent_edges
         << " edges the facets disagree; orient the mesh";
  else
    return;
  throw MeshError(text.str());
}

SurfaceMesh to_cgal(const Mesh& mesh) {
  std::vector<Kernel::Point_3> points;
  for (const Vec3& p : mesh.points) points.emplace_back(p[0], p[1], p[2]);
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c] : mesh.facets)
    triangles.push_back({index_of(a), index_of(b), index_of(c)});
  SurfaceMesh surface;
  PMP::polygon_soup_to_polygon_mesh(points, triangles, surface);
  return surface;
}

Mesh from_cgal(const SurfaceMesh& surface) {
  std::vector<Kernel::Point_3> points;
  std::vector<Triangle> triangles;
  PMP::polygon_mesh_to_polygon_soup(surface, points, triangles);
  Mesh mesh;
  for (const auto& p : points) mesh.points.emplace_back(p.x(), p.y(), p.z());
  for (const auto& [a, b, c] : triangles)
    mesh.facets.push_back({id_at<NodeId>(a), id_at<NodeId>(b), id_at<NodeId>(c)});
  return mesh;
}

}  // namespace

Mesh remesh(const Mesh& mesh, double target_edge) {
  require_remeshable(measure(mesh, false), target_edge);
  SurfaceMesh surface = to_cgal(mesh);
  auto kept = surface.add_property_map<SurfaceMesh::Edge_index, bool>("e:kept", false).first;
  const auto mark = [&] {
    PMP::detect_sharp_edges(surface, kFeatureAngle, kept);
    for (const auto edge : surface.edges())
      if (surface.is_border(edge)) kept[edge] = true;
  };
  mark();
  std::vector<SurfaceMesh::Edge_index> lines;
  for (const auto edge : surface.edges())
    if (kept[edge]) lines.push_back(edge);
  // What is kept must be short enough before, or the rounds would never end.
  PMP::split_long_edges(lines, 4.0 / 3.0 * target_edge, surface);
  mark();
  PMP::isotropic_remeshing(surface.faces(), target_edge, surface,
                           CGAL::parameters::number_of_iterations(kRounds)
                               .edge_is_constrained_map(kept)
                               .protect_constraints(true));
  surface.collect_garbage();
  return from_cgal(surface);
}

}  // namespace plekton::geometry
