// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/bodies.hpp"
#include "geometry/base/state_archive.hpp"
#include "geometry/base/thread_pool.hpp"
#include "geometry/neighbor/broad_phase.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace plekton::contact {

/// How many spheres there are up to the last one of the pairs, a < b.
inline std::size_t spheres_in(std::span<const geometry::IndexPair> pairs) noexcept {
  std::int32_t last = -1;
  for (const geometry::IndexPair& pair : pairs) last = std::max(last, pair.b);
  return static_cast<std::size_t>(last + 1);
}

/// Which of several processes computes which blocks.
struct BlockOwners {
  std::span<const int> of_blocks;  ///< rank by block; empty: this process computes all
  int self = 0;

  bool has(std::size_t block) const noexcept {
    return of_blocks.empty() || of_blocks[block] == self;
  }
};

/// Shares spheres and the pairs that they form out into blocks, so that a block is worked on by one
/// thread, in the cache nearest to it.
///
/// Spheres are put in order along a space-filling curve, and the order is cut into blocks that take
/// equally long, each a clump in space. A sphere is owned by one block. A pair belongs to the block
/// of whichever of its spheres comes first in the order; the block has the other one as a ghost if
/// it does not own it, and what the pair adds to a ghost is handed to its owner afterwards. The
/// blocks depend on the list and on the positions from which it was made, not on the number of
/// threads, and sums are taken in an order that follows from the blocks alone.
class SphereBlocks {
 public:
  /// Pairs side by side in a row; a block has whole rows.
  static constexpr std::size_t kLanes = 8;

  /// Rows of a block that are filled lane by lane: each lane of the rows runs through a range of
  /// the pairs, so that neighbouring lanes add to different spheres, and none has to wait for the
  /// sum of the one before.
  struct Range {
    std::uint32_t first_row;
    std::uint32_t row_count;
    std::uint32_t pair_count;
    std::uint8_t kind;  ///< of all its pairs
    bool was_apart;     ///< none of its pairs touched when the list was made

    /// Row and lane of its pair n.
    std::size_t slot(std::size_t n) const noexcept {
      return (first_row + n % row_count) * kLanes + n / row_count;
    }
    std::size_t slot_count() const noexcept { return row_count * kLanes; }
  };

  struct Block {
    std::uint32_t first_member;  ///< its spheres: those it owns, its ghosts, that of no size
    std::uint32_t owned;         ///< how many it owns
    std::uint32_t member_count;
    std::uint32_t first_ghost;  ///< its ghosts, counted over all blocks
    std::uint32_t first_range;  ///< of each kind those that touched, then those that did not
    std::uint32_t range_count;

    std::uint32_t ghosts() const noexcept { return member_count - 1 - owned; }
  };

  /// A sphere as a member of a block.
  struct Member {
    NodeId node;
    double radius;  ///< m
  };

  /// Nodes [begin, end).
  struct NodeRange {
    std::size_t begin;
    std::size_t end;
  };

  /// Which members of its block a pair joins; a is the sphere with the lower index in the list.
  struct Pair {
    std::uint32_t a, b;
  };

  /// Where a block ends: the place after that of its last sphere in the order.
  struct Cut {
    std::uint64_t place;
    std::uint64_t pairs;  ///< before it
  };

  /// Part of the order, [begin, end), and how many pairs have their first spheres where.
  struct PartOfOrder {
    std::size_t begin;
    std::size_t end;
    std::uint64_t pairs_before;
    std::uint64_t pairs_of_all;
  };

  /// That a block has a sphere as a ghost.
  struct GhostOf {
    std::int32_t sphere;
    std::uint32_t block;
  };

  /// Takes a new list. Allocates only for a longer one than ever before.
  /// @param pairs  of spheres, a < b, sorted; spheres after the last of them are left out
  /// @param kinds  by pair, so that pairs of a kind lie together; empty: all are of kind 0
  /// @param x      m, of nodes; empty: the spheres are in order already, and there are no nodes
  ///               after those of the spheres
  void assign(std::span<const geometry::IndexPair> pairs, std::span<const SphereBody> spheres,
              std::span<const std::uint8_t> kinds, geometry::ThreadPool& pool, Positions x);

  // The same in steps, for ranks that have some of the pairs each and tell each other in between.

  /// First puts the spheres in order.
  void order(std::span<const SphereBody> spheres, Positions x);
  /// How many blocks so many spheres are cut into.
  static std::size_t block_count(std::size_t spheres) noexcept;
  /// Where blocks end in a part of the order.
  /// @param pairs  those whose first spheres lie there
  /// @returns  good until the next call
  std::span<const Cut> find_cuts(std::span<const geometry::IndexPair> pairs,
                                 const PartOfOrder& part);
  /// Then cuts it. @param cuts  of all parts
  void cut(std::span<const Cut> cuts);
  /// Then takes the pairs of the blocks that are here; of others there are no members then.
  void fill(std::span<const geometry::IndexPair> pairs, std::span<const SphereBody> spheres,
            std::span<const std::uint8_t> kinds, const BlockOwners& owners,
            geometry::ThreadPool& pool, Positions x);
  /// Last whose sums are added to spheres of the blocks here: ghosts of these, and of other ranks,
  /// which are counted after these.
  /// @param ghosts  in the order of their blocks, each with its number
  void take_ghosts(std::span<const std::pair<GhostOf, std::uint32_t>> ghosts,
                   std::size_t of_others);

  /// The order of the spheres, which is older than the list: read before the list is assigned.
  void exchange_order(const geometry::StateArchive& archive);

  std::span<const Block> blocks() const noexcept { return blocks_; }
  /// How many spheres there are in blocks: the first of the list.
  std::size_t sphere_count() const noexcept { return order_.size(); }
  /// That owns one of these.
  std::size_t block_of(std::int32_t sphere) const noexcept {
    return block_at(places_[static_cast<std::size_t>(sphere)]);
  }
  /// That owns the sphere at a place in the order.
  std::size_t block_at(std::uint32_t place) const noexcept;
  /// The place of the one of its spheres whose block has a pair.
  std::uint32_t first_place(const geometry::IndexPair& pair) const noexcept {
    return std::min(places_[static_cast<std::size_t>(pair.a)],
                    places_[static_cast<std::size_t>(pair.b)]);
  }
  /// That a block owns, here or elsewhere.
  std::span<const std::int32_t> spheres_of(std::size_t block) const noexcept {
    return std::span(order_).subspan(first_places_[block],
                                     first_places_[block + 1] - first_places_[block]);
  }
  NodeId node_of(std::int32_t sphere) const noexcept {
    return nodes_[static_cast<std::size_t>(sphere)];
  }
  /// What each block costs, here or elsewhere, in pairs.
  std::span<const std::uint64_t> work() const noexcept { return work_; }
  /// Over all blocks here.
  std::size_t member_count() const noexcept { return members_.size(); }
  /// The nodes, in order, that no block owns.
  std::span<const NodeRange> other_nodes() const noexcept { return other_nodes_; }
  /// Of all nodes there are.
  std::size_t node_count() const noexcept { return is_owned_.size(); }
  /// Ghosts, over all blocks, and those of other ranks.
  std::size_t ghost_count() const noexcept { return ghost_count_; }
  std::size_t row_count() const noexcept { return pairs_.size() / kLanes; }
  std::size_t largest_member_count() const noexcept { return largest_member_count_; }

  std::span<const Range> ranges(const Block& block) const noexcept {
    return std::span(ranges_).subspan(block.first_range, block.range_count);
  }
  std::span<const Range> ranges() const noexcept { return ranges_; }
  // Of blocks here.
  std::span<const Member> members(const Block& block) const noexcept {
    return {&members_[block.first_member], block.member_count};
  }
  std::span<const Member> owned(const Block& block) const noexcept {
    return members(block).first(block.owned);
  }
  std::span<const Member> ghosts(const Block& block) const noexcept {
    return members(block).subspan(block.owned, block.ghosts());
  }
  /// The pairs of a row; lanes without a pair join the sphere of no size to itself.
  const Pair* row(std::size_t row) const noexcept { return &pairs_[row * kLanes]; }
  /// Row and lane of pair i of the list: slot / kLanes and slot % kLanes.
  std::uint32_t slot(std::size_t i) const noexcept { return slots_[i]; }

  /// Calls visit(GhostOf, which ghost) for the ghosts of the blocks here, block by block.
  template <class Visit>
  void for_each_ghost_here(const Visit& visit) const {
    for (std::uint32_t k = 0; k < blocks_.size(); ++k) {
      const Block& block = blocks_[k];
      for (std::uint32_t m = block.owned; m + 1 < block.member_count; ++m)
        visit(GhostOf{spheres_[block.first_member + m], k}, block.first_ghost + m - block.owned);
    }
  }

  /// Calls add(node, which ghost) for every sphere that a block owns and that is a ghost of another
  /// one, in a fixed order.
  /// @param ahead  called with the same some calls before, to ask for what add() will read
  template <class Add, class Ahead>
  void for_each_ghost(std::size_t block, Add&& add, Ahead&& ahead) const {
    constexpr std::uint32_t kAhead = 16;
    const std::uint32_t end = first_ghosts_[block + 1];
    for (std::uint32_t i = first_ghosts_[block]; i < end; ++i) {
      const Ghost& later = ghosts_[std::min(i + kAhead, end - 1)];
      ahead(later.node, later.ghost);
      add(ghosts_[i].node, ghosts_[i].ghost);
    }
  }

 private:
  struct Ghost {
    NodeId node;
    std::uint32_t ghost;
  };

  void find_places();
  void count_pairs(std::span<const geometry::IndexPair> pairs);
  void sort_counted(std::span<const geometry::IndexPair> pairs, geometry::ThreadPool& pool);
  void fill_counted(std::span<const geometry::IndexPair> pairs, std::span<const SphereBody> spheres,
                    std::span<const std::uint8_t> kinds, const BlockOwners& owners,
                    geometry::ThreadPool& pool, Positions x);
  void find_touching(std::span<const geometry::IndexPair> pairs,
                     std::span<const SphereBody> spheres, Positions x, geometry::ThreadPool& pool);
  void add_range(std::size_t group, std::size_t pair_count);
  /// Which range of a block a pair goes to: by kind, those that touch first.
  std::size_t group_of(std::size_t pair, std::span<const std::uint8_t> kinds) const noexcept {
    const std::size_t kind = kinds.empty() ? 0 : kinds[pair];
    return 2 * kind + (touches_[pair] != 0 ? 0 : 1);
  }
  void fill_block(std::size_t block, std::span<const geometry::IndexPair> pairs,
                  std::span<const SphereBody> spheres, std::span<const std::uint8_t> kinds);
  /// The member, within its block, that a sphere is; has it as a ghost if need be.
  std::uint32_t member(const Block& block, std::int32_t sphere,
                       std::span<const SphereBody> spheres);
  void add_member(std::int32_t sphere, std::span<const SphereBody> spheres);
  void add_no_block();
  template <class ForEachGhost>
  void place_ghosts(const ForEachGhost& for_each_ghost);
  void find_other_nodes(std::size_t node_count);

  std::vector<std::int32_t> order_;            ///< spheres along the curve
  std::vector<std::uint32_t> places_;          ///< by sphere: where it is in order_
  std::vector<std::uint32_t> first_of_place_;  ///< by place: its first pair in sorted_
  std::vector<std::uint32_t> sorted_;          ///< pairs by place of their first and other sphere
  std::vector<std::uint32_t> first_places_;    ///< by block
  std::vector<std::uint64_t> work_;            ///< by block
  std::vector<Cut> cuts_;
  std::vector<std::uint8_t> touches_;     ///< by pair, 1 or 0, when the list was made
  std::vector<std::uint32_t> member_of_;  ///< by sphere: which member of the last block it was in
  std::vector<Block> blocks_;
  std::vector<Range> ranges_;
  std::vector<std::uint32_t> group_sizes_;   ///< pairs of the last block, by group
  std::vector<std::uint32_t> group_ranges_;  ///< the range of each group
  std::vector<std::uint32_t> group_filled_;
  std::vector<Member> members_;
  std::vector<std::int32_t> spheres_;  ///< by member
  std::vector<Pair> pairs_;            ///< by slot
  std::vector<std::uint32_t> slots_;
  std::vector<Ghost> ghosts_;  ///< by block of the owner
  std::vector<std::uint32_t> first_ghosts_;
  std::vector<NodeRange> other_nodes_;
  std::vector<std::uint8_t> is_owned_;  ///< by node, 1 or 0
  std::vector<NodeId> nodes_;           ///< by sphere
  std::size_t largest_member_count_ = 0;
  std::size_t ghost_count_ = 0;
  int lists_in_order_ = 0;  ///< how many lists were made with this order
};

}  // namespace plekton::contact
