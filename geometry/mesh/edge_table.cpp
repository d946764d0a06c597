// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/edge_table.hpp"

#include <algorithm>
#include <tuple>

namespace plekton::geometry {

EdgeTable::EdgeTable(const Mesh& mesh) {
  require_corners(mesh);
  struct Side {
    std::array<NodeId, 2> nodes;
    std::uint32_t facet;
    std::uint32_t side;
    bool forward;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.facets.size());
  for (std::uint32_t f = 0; f < mesh.facets.size(); ++f) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const NodeId from = mesh.facets[f][k], to = mesh.facets[f][(k + 1) % 3];
      sides.push_back({{std::min(from, to), std::max(from, to)}, f, k, from < to});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.nodes, a.facet, a.side) < std::tie(b.nodes, b.facet, b.side);
  });

  facet_edges_.resize(mesh.facets.size());
  uses_.reserve(sides.size());
  for (const Side& side : sides) {
    if (edges_.empty() || edges_.back() != side.nodes) {
      edges_.push_back(side.nodes);
      start_.push_back(static_cast<std::uint32_t>(uses_.size()));
    }
    facet_edges_[side.facet][side.side] = static_cast<std::uint32_t>(edges_.size() - 1);
    uses_.push_back({side.facet, side.forward});
  }
  start_.push_back(static_cast<std::uint32_t>(uses_.size()));
}

}  // namespace plekton::geometry
