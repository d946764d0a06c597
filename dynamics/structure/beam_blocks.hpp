// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::dynamics {

/// Shares bonds between nodes out into blocks, so that a block is worked on by one thread with the
/// sums of its nodes in the cache nearest to it.
///
/// A block grows from a node over the bonds of its neighbours until it is full, so it is a clump of
/// the structure however the nodes are numbered. A bond belongs to one block, a node to every block
/// that has a bond of it: there it is a member. The blocks depend on the bonds alone, not on the
/// number of threads.
class BeamBlocks {
 public:
  /// Bonds side by side in a row; a block has whole rows.
  static constexpr std::size_t kLanes = 8;
  /// Bonds in a block. Many enough that few nodes are in two blocks, few enough that the threads
  /// get equal shares of a small structure.
  static constexpr std::size_t kFull = 128;

  struct Block {
    std::uint32_t first_member;
    std::uint32_t member_count;
    std::uint32_t first_bond;  ///< among bonds in the order of the blocks
    std::uint32_t bond_count;
    std::uint32_t first_row;
    std::uint32_t row_count;

    /// Row and lane of its bond n. Each lane runs through a stretch of the bonds, so that
    /// neighbouring lanes add to different nodes, and none has to wait for the sum before.
    std::size_t slot(std::size_t n) const noexcept {
      return (first_row + n % row_count) * kLanes + n / row_count;
    }
  };

  /// A bond and its nodes as members of its block.
  struct Bond {
    std::uint32_t index;
    std::array<std::uint32_t, 2> members;
  };

  BeamBlocks() = default;
  /// Linear in the number of bonds and nodes.
  /// @param ends  of each bond two nodes, different and < node_count
  BeamBlocks(std::span<const geometry::NodeId> ends, std::size_t node_count);

  std::span<const Block> blocks() const noexcept { return blocks_; }
  std::span<const Bond> bonds(const Block& block) const noexcept {
    return {bonds_.data() + block.first_bond, block.bond_count};
  }
  std::size_t row_count() const noexcept { return row_count_; }
  /// The nodes of all members, block by block.
  std::span<const geometry::NodeId> members() const noexcept { return members_; }

 private:
  class Growth;

  std::vector<Block> blocks_;
  std::vector<Bond> bonds_;
  std::vector<geometry::NodeId> members_;
  std::size_t row_count_ = 0;
};

/// Numbers 0, 1, ... sorted by the node that each belongs to.
struct ByNode {
  std::vector<std::uint32_t> start;    ///< by node, one more: where its numbers begin
  std::vector<std::uint32_t> numbers;  ///< of a node in ascending order
};
ByNode by_node(std::span<const geometry::NodeId> nodes, std::size_t node_count);

}  // namespace plekton::dynamics
