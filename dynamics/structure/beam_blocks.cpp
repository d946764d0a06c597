// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/beam_blocks.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace plekton::dynamics {

using geometry::index_of;
using geometry::NodeId;

ByNode by_node(std::span<const NodeId> nodes, std::size_t node_count) {
  ByNode sorted{std::vector<std::uint32_t>(node_count + 1, 0),
                std::vector<std::uint32_t>(nodes.size())};
  for (const NodeId node : nodes) ++sorted.start[index_of(node) + 1];
  std::partial_sum(sorted.start.begin(), sorted.start.end(), sorted.start.begin());
  std::vector<std::uint32_t> next(sorted.start.begin(), sorted.start.end() - 1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    sorted.numbers[next[index_of(nodes[i])]++] = static_cast<std::uint32_t>(i);
  return sorted;
}

/// Fills blocks one after the other.
class BeamBlocks::Growth {
 public:
  Growth(std::span<const NodeId> ends, std::size_t node_count, BeamBlocks& result)
      : ends_(ends),
        of_node_(by_node(ends, node_count)),
        next_(of_node_.start.begin(), of_node_.start.end() - 1),
        member_(node_count, kNone),
        is_taken_(ends.size() / 2, false),
        result_(result) {}

  void fill_blocks() {
    while (result_.bonds_.size() < is_taken_.size()) fill_block();
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  void fill_block() {
    const std::size_t bond_count = std::min(kFull, is_taken_.size() - result_.bonds_.size());
    first_member_ = result_.members_.size();
    const std::size_t first_bond = result_.bonds_.size();
    // The members in the order in which they join are the queue of nodes to grow from.
    std::size_t grown = first_member_;
    while (result_.bonds_.size() < first_bond + bond_count) {
      if (grown == result_.members_.size()) join(seed());
      const NodeId node = result_.members_[grown++];
      while (result_.bonds_.size() < first_bond + bond_count && has_bonds_left(node))
        take(of_node_.numbers[next_[index_of(node)]] / 2);
    }
    const std::size_t row_count = (bond_count + kLanes - 1) / kLanes;
    const auto number = [](std::size_t n) { return static_cast<std::uint32_t>(n); };
    result_.blocks_.push_back({number(first_member_),
                               number(result_.members_.size() - first_member_), number(first_bond),
                               number(bond_count), number(result_.row_count_), number(row_count)});
    result_.row_count_ += row_count;
    for (std::size_t m = first_member_; m < result_.members_.size(); ++m)
      member_[index_of(result_.members_[m])] = kNone;
  }

  /// Passes over bonds that were taken from their other ends.
  bool has_bonds_left(NodeId node) {
    std::uint32_t& next = next_[index_of(node)];
    const std::uint32_t end = of_node_.start[index_of(node) + 1];
    while (next < end && is_taken_[of_node_.numbers[next] / 2]) ++next;
    return next < end;
  }

  /// The first node that has bonds left.
  NodeId seed() {
    while (!has_bonds_left(geometry::id_at<NodeId>(seed_))) ++seed_;
    return geometry::id_at<NodeId>(seed_);
  }

  std::uint32_t join(NodeId node) {
    std::uint32_t& member = member_[index_of(node)];
    if (member == kNone) {
      member = static_cast<std::uint32_t>(result_.members_.size() - first_member_);
      result_.members_.push_back(node);
    }
    return member;
  }

  void take(std::uint32_t bond) {
    is_taken_[bond] = true;
    const std::uint32_t a = join(ends_[2 * bond]);
    const std::uint32_t b = join(ends_[2 * bond + 1]);
    result_.bonds_.push_back({bond, {a, b}});
  }

  std::span<const NodeId> ends_;
  ByNode of_node_;                     // ends of bonds: twice the bond, plus 1 at its second node
  std::vector<std::uint32_t> next_;    // by node: the first of its ends that may be left
  std::vector<std::uint32_t> member_;  // by node: in the block that grows, or kNone
  std::vector<bool> is_taken_;         // by bond
  std::size_t first_member_ = 0;       // of the block that grows
  std::size_t seed_ = 0;
  BeamBlocks& result_;
};

BeamBlocks::BeamBlocks(std::span<const NodeId> ends, std::size_t node_count) {
  Growth(ends, node_count, *this).fill_blocks();
}

}  // namespace plekton::dynamics
