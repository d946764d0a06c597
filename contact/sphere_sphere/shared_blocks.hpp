// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "contact/base/rank_share.hpp"
#include "contact/sphere_sphere/block_totals.hpp"
#include "contact/sphere_sphere/shared_motion.hpp"
#include "contact/sphere_sphere/sphere_blocks.hpp"
#include "contact/sphere_sphere/sphere_sums.hpp"
#include "geometry/base/ranks.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact {

/// Which rank computes which blocks of spheres, and what ranks tell each other of them.
///
/// A rank has whole blocks, so no sum is taken in another order than by one process: what a block
/// adds to spheres of another block goes to the rank that has that one, which adds it in the order
/// of the blocks as ever. Then all ranks are given the forces on all common spheres
/// (shared_motion.hpp).
class SharedBlocks {
 public:
  explicit SharedBlocks(geometry::Ranks& ranks) : ranks_(&ranks), motion_(ranks) {}

  /// What a block costs, in pairs: to move a sphere takes about as long as two of them.
  static std::uint64_t work_of(const SphereBlocks& blocks, const SphereBlocks::Block& block);

  /// Takes the blocks of a new list. Owners stay with them until the next one, as nobody else holds
  /// their rows; share_motion() has to follow.
  void assign(const SphereBlocks& blocks);
  /// @param blocks  the same
  /// @param met     as SharedMotion::assign() has it
  void share_motion(const SphereBlocks& blocks, std::span<const NodeId> met);

  geometry::Ranks& ranks() const noexcept { return *ranks_; }
  SharedMotion& motion() noexcept { return motion_; }
  /// Whether there is anything to share: one block, or one rank, needs no message. Each rank then
  /// computes all.
  bool is_worth_it() const noexcept { return ranks_->count() > 1 && owners_.size() > 1; }
  /// The rank that holds the rows of each block; empty where each has all.
  std::span<const int> holders() const noexcept {
    return is_worth_it() ? std::span<const int>(owners_) : std::span<const int>();
  }
  // Those of this rank, ascending.
  std::span<const std::uint32_t> own() const noexcept { return own_; }
  /// With ghosts of other ranks.
  std::span<const std::uint32_t> border() const noexcept { return border_; }
  /// Without.
  std::span<const std::uint32_t> inner() const noexcept { return inner_; }

  /// Begins to send the sums of ghosts of border blocks to the ranks that have their spheres.
  /// @param sums  by ghost
  void begin_ghosts(std::span<const SphereSum> sums);
  /// Takes the sums of this rank's spheres in blocks of others.
  void end_ghosts(std::span<SphereSum> sums);

  /// Gives all ranks the forces on the common spheres of all blocks, and what the blocks came to.
  /// @param of_own  of the blocks of this rank
  /// @returns       of all blocks
  BlockTotals gather(NodeForces& forces, const BlockTotals& of_own);

  /// What each rank does, since the last list; nothing where all do all.
  std::vector<RankShare> shares() const;

 private:
  /// What is told of a sphere: force and torque.
  static constexpr std::size_t kSphereBytes = 6 * sizeof(double);

  void find_messages(const SphereBlocks& blocks);
  void find_sizes_of_gather();

  /// Ghosts whose sums go to a rank or come from one, in the order of ranks.
  struct Messages {
    std::vector<std::uint32_t> ghosts;
    std::vector<std::size_t> sizes;  ///< bytes, by rank
    std::vector<std::byte> bytes;
  };

  geometry::Ranks* ranks_;
  SharedMotion motion_;
  std::vector<int> owners_;                            ///< by block
  std::vector<std::uint32_t> own_, border_, inner_;    ///< blocks of this rank
  std::vector<std::vector<std::uint32_t>> blocks_of_;  ///< by rank
  Messages sent_;
  Messages received_;
  std::vector<std::size_t> sizes_;  ///< bytes, by rank
  std::vector<std::byte> parts_;
};

}  // namespace plekton::contact
