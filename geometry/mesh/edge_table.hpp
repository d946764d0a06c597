// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::geometry {

/// A facet at an edge: does it run from the lower to the higher node?
struct EdgeUse {
  std::uint32_t facet;
  bool forward;
};

/// Every edge of a mesh once, with all facets that share it.
class EdgeTable {
 public:
  /// n log n in the number of facets. Facets must name three different nodes.
  /// @throws MeshError for one that names a point which is not there
  explicit EdgeTable(const Mesh& mesh);

  std::size_t size() const noexcept { return edges_.size(); }
  /// Lower node first; in ascending order.
  const std::vector<std::array<NodeId, 2>>& edges() const noexcept { return edges_; }
  /// Facets at an edge, ascending.
  std::span<const EdgeUse> uses(std::size_t edge) const noexcept {
    return {uses_.data() + start_[edge], uses_.data() + start_[edge + 1]};
  }
  /// Edges of a facet; side k joins corners k and k + 1 (mod 3).
  const std::array<std::uint32_t, 3>& edges_of(std::size_t facet) const noexcept {
    return facet_edges_[facet];
  }

 private:
  std::vector<std::array<NodeId, 2>> edges_;
  std::vector<std::uint32_t> start_;
  std::vector<EdgeUse> uses_;
  std::vector<std::array<std::uint32_t, 3>> facet_edges_;
};

}  // namespace plekton::geometry
