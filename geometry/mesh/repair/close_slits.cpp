// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/close_slits.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <vector>

namespace plekton::geometry {
namespace {

using Edge = std::array<NodeId, 2>;  // lower node first

Edge edge_of(NodeId a, NodeId b) {
  return {std::min(a, b), std::max(a, b)};
}

/// A facet without area: its corners as they lie on their line.
struct Flat {
  NodeId a;
  NodeId middle;
  NodeId c;

  std::array<Edge, 2> short_sides() const { return {edge_of(a, middle), edge_of(middle, c)}; }
};

class SlitCloser {
 public:
  SlitCloser(Mesh& mesh, std::span<const std::array<NodeId, 3>> dropped) : mesh_(mesh) {
    std::vector<bool> is_near(mesh.points.size(), false);
    for (const auto& corners : dropped) {
      flats_.push_back(in_line(corners));
      for (const NodeId node : corners) is_near[index_of(node)] = true;
    }
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
      const auto& nodes = mesh.facets[f];
      if (!std::any_of(nodes.begin(), nodes.end(), [&](NodeId n) { return is_near[index_of(n)]; }))
        continue;
      for (std::size_t k = 0; k < 3; ++k) facets_at_[side(f, k)].push_back(f);
    }
    for (std::size_t i = 0; i < flats_.size(); ++i) {
      flats_along_[edge_of(flats_[i].a, flats_[i].c)].push_back(i);
      for (const Edge& edge : flats_[i].short_sides()) ++flat_sides_[edge];
    }
  }

  std::size_t close_all() {
    std::size_t count = 0;
    std::deque<std::size_t> waiting;
    for (std::size_t i = 0; i < flats_.size(); ++i) waiting.push_back(i);
    for (; !waiting.empty(); waiting.pop_front()) {
      const Flat& flat = flats_[waiting.front()];
      if (!close(flat)) continue;
      ++count;
      // A facet without area that lies on one of these edges has a facet beyond it only now.
      for (const Edge& edge : flat.short_sides()) {
        const auto along = flats_along_.find(edge);
        if (along != flats_along_.end())
          waiting.insert(waiting.end(), along->second.begin(), along->second.end());
      }
    }
    return count;
  }

 private:
  Edge side(std::size_t facet, std::size_t k) const {
    return edge_of(mesh_.facets[facet][k], mesh_.facets[facet][(k + 1) % 3]);
  }

  std::size_t count_at(const Edge& edge) const {
    const auto found = facets_at_.find(edge);
    return found == facets_at_.end() ? 0 : found->second.size();
  }

  /// Different points of a line differ along the axis along which they are furthest apart.
  Flat in_line(std::array<NodeId, 3> corners) const {
    const auto x = [&](NodeId node) -> const Vec3& { return mesh_.points[index_of(node)]; };
    const Vec3 lower = x(corners[0]).cwiseMin(x(corners[1])).cwiseMin(x(corners[2]));
    const Vec3 upper = x(corners[0]).cwiseMax(x(corners[1])).cwiseMax(x(corners[2]));
    Eigen::Index axis = 0;
    (upper - lower).maxCoeff(&axis);
    std::sort(corners.begin(), corners.end(),
              [&](NodeId i, NodeId j) { return x(i)[axis] < x(j)[axis]; });
    return {corners[0], corners[1], corners[2]};
  }

  bool joins_something(const Flat& flat) const {
    const auto sides = flat.short_sides();
    return std::any_of(sides.begin(), sides.end(), [&](const Edge& edge) {
      return count_at(edge) == 1 || flat_sides_.at(edge) > 1 || flats_along_.contains(edge);
    });
  }

  bool close(const Flat& flat) {
    const Edge longest = edge_of(flat.a, flat.c);
    const auto sides = flat.short_sides();
    if (count_at(longest) != 1 || !joins_something(flat) || count_at(sides[0]) > 1 ||
        count_at(sides[1]) > 1)
      return false;
    const std::size_t facet = facets_at_.at(longest).front();
    std::size_t k = 0;
    while (side(facet, k) != longest) ++k;
    const auto& nodes = mesh_.facets[facet];
    const NodeId p = nodes[k], q = nodes[(k + 1) % 3], d = nodes[(k + 2) % 3];
    if (count_at(edge_of(flat.middle, d)) > 0) return false;
    split(facet, {p, q, d}, flat.middle);
    return true;
  }

  /// p, q, d becomes p, middle, d and middle, q, d.
  void split(std::size_t facet, const std::array<NodeId, 3>& corners, NodeId middle) {
    const auto [p, q, d] = corners;
    const std::size_t added = mesh_.facets.size();
    mesh_.facets[facet] = {p, middle, d};
    mesh_.facets.push_back({middle, q, d});
    facets_at_.erase(edge_of(p, q));
    std::replace(facets_at_[edge_of(q, d)].begin(), facets_at_[edge_of(q, d)].end(), facet, added);
    facets_at_[edge_of(p, middle)].push_back(facet);
    facets_at_[edge_of(middle, q)].push_back(added);
    facets_at_[edge_of(middle, d)] = {facet, added};
  }

  Mesh& mesh_;
  std::vector<Flat> flats_;
  std::map<Edge, std::vector<std::size_t>> facets_at_;    // that have a corner of a flat one
  std::map<Edge, std::vector<std::size_t>> flats_along_;  // by their longest side
  std::map<Edge, int> flat_sides_;                        // how many of their short sides
};

}  // namespace

std::size_t close_slits(Mesh& mesh, std::span<const std::array<NodeId, 3>> dropped) {
  return dropped.empty() ? 0 : SlitCloser(mesh, dropped).close_all();
}

}  // namespace plekton::geometry
