// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/measures.hpp"

#include "geometry/base/elementary.hpp"
#include "geometry/mesh/disjoint_sets.hpp"
#include "geometry/mesh/repair/orientation.hpp"
#include "geometry/mesh/repair/solid_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace plekton::geometry {
namespace {

void count_edges(const EdgeTable& edges, MeshMeasures& m) {
  m.edges = edges.size();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto uses = edges.uses(e);
    if (uses.size() == 1) ++m.border_edges;
    if (uses.size() > 2) ++m.many_facet_edges;
    if (uses.size() == 2 && uses[0].forward == uses[1].forward) ++m.inconsistent_edges;
  }
}

std::size_t count_components(const Mesh& mesh) {
  DisjointSets sets(mesh.points.size());
  std::vector<bool> used(mesh.points.size(), false);
  for (const auto& [a, b, c] : mesh.facets) {
    sets.unite(index_of(a), index_of(b));
    sets.unite(index_of(a), index_of(c));
    used[index_of(a)] = used[index_of(b)] = used[index_of(c)] = true;
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i] && sets.find(i) == i) ++count;
  return count;
}

/// The side of a facet opposite a node: a piece of the node's link.
struct LinkPiece {
  NodeId node;
  std::array<NodeId, 2> ends;
};

std::vector<LinkPiece> links_by_node(const Mesh& mesh) {
  std::vector<LinkPiece> pieces;
  pieces.reserve(3 * mesh.facets.size());
  for (const auto& facet : mesh.facets)
    for (std::size_t k = 0; k < 3; ++k)
      pieces.push_back({facet[k], {facet[(k + 1) % 3], facet[(k + 2) % 3]}});
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const auto& a, const auto& b) { return a.node < b.node; });
  return pieces;
}

/// Is the link one path or one cycle: connected, and no end in more than two pieces?
bool is_path_or_cycle(std::span<const LinkPiece> link) {
  std::vector<NodeId> ends;
  for (const LinkPiece& piece : link) ends.insert(ends.end(), piece.ends.begin(), piece.ends.end());
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 2; i < ends.size(); ++i)
    if (ends[i - 2] == ends[i]) return false;
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());

  const auto place = [&](NodeId node) {
    return static_cast<std::size_t>(std::lower_bound(ends.begin(), ends.end(), node) -
                                    ends.begin());
  };
  DisjointSets sets(ends.size());
  std::size_t parts = ends.size();
  for (const LinkPiece& piece : link)
    if (sets.unite(place(piece.ends[0]), place(piece.ends[1]))) --parts;
  return parts == 1;
}

std::size_t count_non_manifold_nodes(const Mesh& mesh) {
  const auto pieces = links_by_node(mesh);
  std::size_t count = 0;
  for (std::size_t begin = 0; begin < pieces.size();) {
    std::size_t end = begin;
    while (end < pieces.size() && pieces[end].node == pieces[begin].node) ++end;
    if (!is_path_or_cycle(std::span(pieces).subspan(begin, end - begin))) ++count;
    begin = end;
  }
  return count;
}

/// The norm, also where squares vanish.
double norm_of(const Vec3& v) {
  constexpr double kSmallestWithSquares = 1e-150;
  const double norm = v.norm();
  return norm > kSmallestWithSquares ? norm : v.stableNorm();
}

double angle_degrees(const Vec3& u, const Vec3& v) {
  return elementary::atan2(norm_of(u.cross(v)), u.dot(v)) * 180.0 / std::numbers::pi;
}

void measure_facets(const Mesh& mesh, MeshMeasures& m) {
  m.smallest_angle = smallest_angle(mesh);
  for (const auto& [a, b, c] : mesh.facets) {
    const Vec3& x = mesh.points[index_of(a)];
    m.area += 0.5 * norm_of((mesh.points[index_of(b)] - x)
                                .cross(mesh.points[index_of(c)] - mesh.points[index_of(b)]));
  }
}

void measure_edges(const Mesh& mesh, const EdgeTable& edges, MeshMeasures& m) {
  if (edges.size() == 0) return;
  m.shortest_edge = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : edges.edges()) {
    const double length = norm_of(mesh.points[index_of(b)] - mesh.points[index_of(a)]);
    m.shortest_edge = std::min(m.shortest_edge, length);
    m.longest_edge = std::max(m.longest_edge, length);
    m.mean_edge += length / static_cast<double>(edges.size());
  }
}

double volume_of(const Mesh& mesh) {
  const Vec3 origin = mesh.points[index_of(mesh.facets.front()[0])];
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.facets) {
    const Vec3 xa = mesh.points[index_of(a)] - origin;
    const Vec3 xb = mesh.points[index_of(b)] - origin;
    const Vec3 xc = mesh.points[index_of(c)] - origin;
    sum += xa.dot(xb.cross(xc)) / 6.0;
  }
  return sum;
}

/// Does the mesh run along every edge as often one way as the other?
bool has_no_boundary(const EdgeTable& edges) {
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto uses = edges.uses(e);
    const auto forward =
        std::count_if(uses.begin(), uses.end(), [](const EdgeUse& use) { return use.forward; });
    if (2 * static_cast<std::size_t>(forward) != uses.size()) return false;
  }
  return true;
}

void measure_solid(const Mesh& mesh, const EdgeTable& edges, bool intersections, MeshMeasures& m) {
  m.closed = !mesh.facets.empty() && m.border_edges == 0;
  if (m.closed && has_no_boundary(edges)) m.volume = volume_of(mesh);
  if (!intersections) return;
  m.self_intersections = self_intersections(mesh).size();
  if (m.closed && *m.self_intersections == 0) m.bounds_volume = bounds_volume(mesh);
}

}  // namespace

double smallest_angle(const Mesh& mesh) {
  require_corners(mesh);
  double smallest = mesh.facets.empty() ? 0.0 : 180.0;
  for (const auto& facet : mesh.facets) {
    std::array<Vec3, 3> side;  // From corner k to the next.
    for (std::size_t k = 0; k < 3; ++k)
      side[k] = mesh.points[index_of(facet[(k + 1) % 3])] - mesh.points[index_of(facet[k])];
    for (std::size_t k = 0; k < 3; ++k)
      smallest = std::min(smallest, angle_degrees(side[k], -side[(k + 2) % 3]));
  }
  return smallest;
}

MeshMeasures measure(const Mesh& mesh, bool intersections) {
  const EdgeTable edges(mesh);
  MeshMeasures m;
  m.points = mesh.points.size();
  m.facets = mesh.facets.size();
  count_edges(edges, m);
  m.components = count_components(mesh);
  m.non_manifold_nodes = count_non_manifold_nodes(mesh);
  m.non_orientable_patches = find_orientation(mesh, edges).non_orientable_patches;
  m.euler_characteristic = static_cast<long long>(m.points) - static_cast<long long>(m.edges) +
                           static_cast<long long>(m.facets);
  if (!mesh.points.empty()) m.bounds = {mesh.points.front(), mesh.points.front()};
  for (const Vec3& p : mesh.points)
    m.bounds = {m.bounds.lower.cwiseMin(p), m.bounds.upper.cwiseMax(p)};
  measure_facets(mesh, m);
  measure_edges(mesh, edges, m);
  measure_solid(mesh, edges, intersections, m);
  return m;
}

}  // namespace plekton::geometry
