// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace plekton::geometry {

/// Groups of nodes whose elements are never paired with each other, as those of one rigid body.
class ExclusionGroups {
 public:
  /// Nothing is excluded.
  ExclusionGroups() = default;
  /// @param group_of_node  by NodeId; -1: in no group
  explicit ExclusionGroups(std::vector<std::int32_t> group_of_node)
      : group_of_node_(std::move(group_of_node)) {}

  bool empty() const noexcept { return group_of_node_.empty(); }

  /// -1: in no group.
  std::int32_t group_of(NodeId node) const noexcept {
    return empty() ? -1 : group_of_node_[index_of(node)];
  }

  /// Whether two elements have nodes in the same group.
  bool exclude(std::span<const NodeId> a, std::span<const NodeId> b) const noexcept {
    if (empty()) return false;
    for (const NodeId node : a) {
      const std::int32_t group = group_of_node_[index_of(node)];
      if (group < 0) continue;
      for (const NodeId other : b) {
        if (group_of_node_[index_of(other)] == group) return true;
      }
    }
    return false;
  }

 private:
  std::vector<std::int32_t> group_of_node_;
};

}  // namespace plekton::geometry
