// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/node_members.hpp"

#include <algorithm>
#include <utility>

namespace plekton::dynamics {

template <std::size_t N>
NodeMembers<N>::NodeMembers(std::vector<Group> groups) : groups_(std::move(groups)) {
  std::vector<std::pair<NodeId, std::size_t>> slots;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    for (std::size_t k = 0; k < N; ++k) slots.emplace_back(groups_[g][k], g * N + k);
  }
  std::sort(slots.begin(), slots.end());
  for (const auto& [node, slot] : slots) {
    if (nodes_.empty() || nodes_.back() != node) {
      nodes_.push_back(node);
      start_.push_back(members_.size());
    }
    members_.push_back({slot / N, slot % N});
  }
  start_.push_back(members_.size());
}

template class NodeMembers<2>;
template class NodeMembers<3>;

}  // namespace plekton::dynamics
