// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/facet.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

/// Elements told by their nodes, in whatever order these are.
namespace plekton::geometry {

/// Ascending.
template <std::size_t N>
std::array<NodeId, N> sorted(std::array<NodeId, N> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// Side k goes from corner k to corner k + 1 (mod 3).
inline std::array<std::array<NodeId, 2>, 3> sides_of(const Facet& facet) noexcept {
  const auto& [a, b, c] = facet.nodes;
  return {{{a, b}, {b, c}, {c, a}}};
}

/// Sets of N nodes, in any order of each.
template <std::size_t N>
class NodeSets {
 public:
  void add(const std::array<NodeId, N>& nodes) { sets_.push_back(sorted(nodes)); }
  /// After the last add, before contains().
  void sort() { std::sort(sets_.begin(), sets_.end()); }
  bool contains(const std::array<NodeId, N>& nodes) const {
    return std::binary_search(sets_.begin(), sets_.end(), sorted(nodes));
  }
  bool empty() const noexcept { return sets_.empty(); }

 private:
  std::vector<std::array<NodeId, N>> sets_;
};

/// Of all facets.
inline NodeSets<2> set_of_sides(std::span<const Facet> facets) {
  NodeSets<2> sides;
  for (const Facet& facet : facets)
    for (const std::array<NodeId, 2>& side : sides_of(facet)) sides.add(side);
  sides.sort();
  return sides;
}

}  // namespace plekton::geometry
