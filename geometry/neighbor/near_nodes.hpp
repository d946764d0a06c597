// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/elements.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace plekton::geometry {

/// Which nodes of a surface are near each other along its edges at rest: at most two diameters of
/// their structure, because a thick body cannot fold more sharply than that.
///
/// Distances are those between groups of nodes. A group holds the nodes at most 0.2 diameters along
/// edges from its centre, so where edges are longer every node is a group of its own and the
/// distances are exact. Where edges are far shorter than thick, two nodes count as near if the
/// centres of their groups are, which is off by at most 0.4 diameters; the groups within two
/// diameters are a bounded number, so that making the lists takes O(n log n) for n nodes of a
/// surface of any fineness, as long as a bounded number of edges meet in a node.
class NearNodes {
 public:
  /// No nodes.
  NearNodes() = default;

  /// Pairs of groups: lists as long take 0.4 GB. Edges as long as thick make about 20 for each
  /// node.
  static constexpr std::size_t kMostPairs = 100'000'000;

  /// @param rest        m, where the nodes are when the structures are at rest
  /// @param most_pairs  of groups that are near each other, each counted from both sides
  /// @throws std::length_error for more of them by a sample, as where very many edges meet in a
  ///         node
  NearNodes(const Surface& surface, Positions rest, std::size_t most_pairs = kMostPairs);

  /// A node is near itself. Both must belong to cells of the surface.
  bool are_near(NodeId a, NodeId b) const noexcept;

  std::int32_t group_of(NodeId node) const noexcept { return group_[index_of(node)]; }
  /// Ascending; the group itself is one of them.
  std::span<const std::int32_t> groups_near(std::int32_t group) const noexcept {
    const auto g = static_cast<std::size_t>(group);
    return std::span(near_).subspan(first_[g], first_[g + 1] - first_[g]);
  }
  bool are_groups_near(std::int32_t a, std::int32_t b) const noexcept;
  std::size_t group_count() const noexcept { return first_.empty() ? 0 : first_.size() - 1; }

 private:
  std::vector<std::int32_t> group_;  ///< by NodeId; -1: a node of no cell
  std::vector<std::size_t> first_;   ///< by group: where its near groups begin in near_
  std::vector<std::int32_t> near_;
};

}  // namespace plekton::geometry
