// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/fill_holes.hpp"

#include "geometry/mesh/edge_table.hpp"
#include "geometry/mesh/repair/exact_signs.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

namespace plekton::geometry {
namespace {

using Loop = std::vector<NodeId>;
using Edge = std::array<NodeId, 2>;

Edge ascending(NodeId a, NodeId b) {
  return {std::min(a, b), std::max(a, b)};
}

/// The node that follows each along the border, walked against the facets so that a filling agrees
/// with them.
class Border {
 public:
  Border(const Mesh& mesh, const EdgeTable& edges) : next_(mesh.points.size(), kNone) {
    std::vector<int> in(mesh.points.size(), 0), out(mesh.points.size(), 0);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (edges.uses(e).size() != 1) continue;
      auto [from, to] = edges.edges()[e];
      if (edges.uses(e).front().forward) std::swap(from, to);
      next_[index_of(from)] = to;
      ++out[index_of(from)];
      ++in[index_of(to)];
    }
    for (std::size_t i = 0; i < next_.size(); ++i) {
      if (in[i] == out[i] && in[i] <= 1) continue;
      next_[i] = kNone;
      ++branches_;
    }
  }

  /// Loops that meet no branch, each from its lowest node on.
  std::vector<Loop> loops() const {
    std::vector<Loop> all;
    std::vector<bool> seen(next_.size(), false);
    for (std::size_t start = 0; start < next_.size(); ++start) {
      Loop loop;
      NodeId node = id_at<NodeId>(start);
      for (; node != kNone && !seen[index_of(node)]; node = next_[index_of(node)]) {
        if (next_[index_of(node)] != kNone) loop.push_back(node);
        seen[index_of(node)] = true;
      }
      if (!loop.empty() && node == loop.front()) all.push_back(std::move(loop));
    }
    return all;
  }
  /// Nodes at which the border does not go on in one way.
  std::size_t branches() const { return branches_; }

 private:
  static constexpr NodeId kNone{-1};
  std::vector<NodeId> next_;
  std::size_t branches_ = 0;
};

double length_of(const Mesh& mesh, const Loop& loop) {
  double length = 0.0;
  for (std::size_t k = 0; k < loop.size(); ++k)
    length += (mesh.points[index_of(loop[(k + 1) % loop.size()])] - mesh.points[index_of(loop[k])])
                  .norm();
  return length;
}

struct Corners {
  int a, b, c;
  Corners(int i, int j, int k) : a(i), b(j), c(k) {}
};

std::vector<std::array<NodeId, 3>> filling_of(const Mesh& mesh, const Loop& loop) {
  std::vector<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3> points;
  for (const NodeId node : loop) {
    const Vec3& p = mesh.points[index_of(node)];
    points.emplace_back(p[0], p[1], p[2]);
  }
  std::vector<Corners> corners;
  CGAL::Polygon_mesh_processing::triangulate_hole_polyline(points, std::back_inserter(corners));
  std::vector<std::array<NodeId, 3>> facets;
  const auto node_at = [&](int k) { return loop[static_cast<std::size_t>(k)]; };
  for (const auto& [a, b, c] : corners) facets.push_back({node_at(a), node_at(b), node_at(c)});
  return facets;
}

/// Does a filling cut the loop into facets with areas, over edges that are its own?
bool is_sound(const Mesh& mesh, const Loop& loop, const std::set<Edge>& existing,
              const std::vector<std::array<NodeId, 3>>& facets) {
  if (facets.size() + 2 != loop.size()) return false;
  std::set<Edge> rim;
  for (std::size_t k = 0; k < loop.size(); ++k)
    rim.insert(ascending(loop[k], loop[(k + 1) % loop.size()]));
  for (const auto& facet : facets) {
    if (are_collinear(mesh.points[index_of(facet[0])], mesh.points[index_of(facet[1])],
                      mesh.points[index_of(facet[2])]))
      return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge edge = ascending(facet[k], facet[(k + 1) % 3]);
      if (!rim.contains(edge) && existing.contains(edge)) return false;
    }
  }
  return true;
}

std::set<std::array<NodeId, 3>> sorted_facets(const Mesh& mesh) {
  std::set<std::array<NodeId, 3>> all;
  for (auto facet : mesh.facets) {
    std::sort(facet.begin(), facet.end());
    all.insert(facet);
  }
  return all;
}

}  // namespace

FilledHoles fill_holes(Mesh& mesh, double longest) {
  const EdgeTable table(mesh);
  const Border border(mesh, table);
  const std::vector<Loop> loops = border.loops();
  FilledHoles result;
  result.left = border.branches();
  if (loops.empty()) return result;

  std::set<Edge> edges(table.edges().begin(), table.edges().end());
  const auto facets_before = sorted_facets(mesh);
  for (const Loop& loop : loops) {
    if (length_of(mesh, loop) > longest) continue;
    const auto filling =
        loop.size() > kLargestHole ? decltype(mesh.facets){} : filling_of(mesh, loop);
    const bool repeats = std::any_of(filling.begin(), filling.end(), [&](auto facet) {
      std::sort(facet.begin(), facet.end());
      return facets_before.contains(facet);
    });
    if (repeats || !is_sound(mesh, loop, edges, filling)) {
      ++result.left;
      continue;
    }
    for (const auto& facet : filling) {
      mesh.facets.push_back(facet);
      for (std::size_t k = 0; k < 3; ++k) edges.insert(ascending(facet[k], facet[(k + 1) % 3]));
    }
    ++result.filled;
    result.facets += filling.size();
  }
  return result;
}

}  // namespace plekton::geometry
