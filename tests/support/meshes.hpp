// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/repair/repair.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

/// Meshes for tests: repaired with their report, taken apart, put together, compared.
namespace plekton::test {

using namespace plekton::geometry;

struct Repaired {
  Mesh mesh;
  MeshReport report;
};

inline Repaired repaired(const PolygonSoup& soup, const RepairOptions& options = {}) {
  Repaired result;
  result.mesh = repair(soup, options, result.report);
  return result;
}

/// Every facet with its own points, as in an STL file.
inline PolygonSoup unshared(const Mesh& mesh) {
  PolygonSoup soup;
  for (const auto& facet : mesh.facets) {
    auto& polygon = soup.polygons.emplace_back();
    for (const NodeId node : facet) {
      polygon.push_back(soup.points.size());
      soup.points.push_back(mesh.points[index_of(node)]);
    }
  }
  return soup;
}

/// Facets as sets of positions: what a mesh is, however it is numbered.
inline std::set<std::vector<std::array<double, 3>>> shape(const Mesh& mesh) {
  std::set<std::vector<std::array<double, 3>>> facets;
  for (const auto& facet : mesh.facets) {
    std::vector<std::array<double, 3>> corners;
    for (const NodeId node : facet) {
      const Vec3& p = mesh.points[index_of(node)];
      corners.push_back({p[0], p[1], p[2]});
    }
    // Cyclic order is the same facet, the reverse is not.
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    facets.insert(corners);
  }
  return facets;
}

/// Meshes side by side, sharing nothing.
inline Mesh together(const std::vector<Mesh>& parts) {
  Mesh all;
  for (const Mesh& part : parts) {
    const std::size_t first = all.points.size();
    all.points.insert(all.points.end(), part.points.begin(), part.points.end());
    for (auto facet : part.facets) {
      for (NodeId& node : facet) node = id_at<NodeId>(index_of(node) + first);
      all.facets.push_back(facet);
    }
  }
  return all;
}

inline Mesh inside_out(Mesh mesh) {
  for (auto& facet : mesh.facets) std::swap(facet[1], facet[2]);
  return mesh;
}

}  // namespace plekton::test
