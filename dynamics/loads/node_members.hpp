// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace plekton::dynamics {

/// The nodes of many groups of N nodes, and in which groups each of them is: to sum over the groups
/// of a node in a fixed order. There are those of pairs and of corners of facets.
template <std::size_t N>
class NodeMembers {
 public:
  using Group = std::array<NodeId, N>;

  /// A node of a group.
  struct Member {
    std::size_t group;
    std::size_t place;  ///< in the group
  };

  explicit NodeMembers(std::vector<Group> groups);

  const std::vector<Group>& groups() const noexcept { return groups_; }
  /// Each once, ascending.
  const std::vector<NodeId>& nodes() const noexcept { return nodes_; }
  /// Where nodes()[i] is a member, by group.
  std::span<const Member> of(std::size_t i) const noexcept {
    return {members_.data() + start_[i], start_[i + 1] - start_[i]};
  }

 private:
  std::vector<Group> groups_;
  std::vector<NodeId> nodes_;
  std::vector<std::size_t> start_;
  std::vector<Member> members_;
};

extern template class NodeMembers<2>;
extern template class NodeMembers<3>;

}  // namespace plekton::dynamics
