// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>
#include <vector>

namespace plekton::geometry {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// The facets of a mesh as CGAL's functions take them.
struct CgalSoup {
  std::vector<Kernel::Point_3> points;
  std::vector<std::array<std::size_t, 3>> triangles;
};

inline CgalSoup to_cgal(const Mesh& mesh) {
  CgalSoup soup;
  for (const Vec3& p : mesh.points) soup.points.emplace_back(p[0], p[1], p[2]);
  for (const auto& [a, b, c] : mesh.facets)
    soup.triangles.push_back({index_of(a), index_of(b), index_of(c)});
  return soup;
}

inline Mesh to_mesh(const SurfaceMesh& surface) {
  CgalSoup soup;
  CGAL::Polygon_mesh_processing::polygon_mesh_to_polygon_soup(surface, soup.points, soup.triangles);
  Mesh mesh;
  for (const auto& p : soup.points) mesh.points.emplace_back(p.x(), p.y(), p.z());
  for (const auto& [a, b, c] : soup.triangles)
    mesh.facets.push_back({id_at<NodeId>(a), id_at<NodeId>(b), id_at<NodeId>(c)});
  return mesh;
}

}  // namespace plekton::geometry
