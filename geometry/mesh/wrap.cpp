// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/wrap.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <cmath>
#include <sstream>
#include <vector>

namespace plekton::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Triangle = std::array<std::size_t, 3>;

constexpr double kOffsetRatio =
    30.0;  // Recommended by CGAL's manual for meshes: alpha over offset.
constexpr double kFinestRatio = 2000.0;

void require_wrappable(const Mesh& mesh, double finest) {
  Vec3 lower = mesh.points.front(), upper = lower;
  for (const Vec3& p : mesh.points) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  const double least = (upper - lower).norm() / kFinestRatio;
  if (finest >= least && finest > 0.0 && std::isfinite(finest)) return;
  std::ostringstream text;
  text << "a wrap of " << finest << " m; expected a length of at least " << least
       << " m, 1/2000 of the size of the mesh";
  throw MeshError(text.str());
}

}  // namespace

Mesh wrap(const Mesh& mesh, double finest) {
  require_wrappable(mesh, finest);
  std::vector<Kernel::Point_3> points;
  for (const Vec3& p : mesh.points) points.emplace_back(p[0], p[1], p[2]);
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c] : mesh.facets)
    triangles.push_back({index_of(a), index_of(b), index_of(c)});
  SurfaceMesh surface;
  CGAL::alpha_wrap_3(points, triangles, finest, finest / kOffsetRatio, surface);

  points.clear();
  triangles.clear();
  CGAL::Polygon_mesh_processing::polygon_mesh_to_polygon_soup(surface, points, triangles);
  Mesh wrapped;
  for (const auto& p : points) wrapped.points.emplace_back(p.x(), p.y(), p.z());
  for (const auto& [a, b, c] : triangles)
    wrapped.facets.push_back({id_at<NodeId>(a), id_at<NodeId>(b), id_at<NodeId>(c)});
  return wrapped;
}

}  // namespace plekton::geometry
