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
/// A rank has whole blocks, and the pairs in them alone. So no sum is taken in another order than by
/// one process: what a block adds to spheres of another block goes to the rank that has that one,
/// which adds it in the order of the blocks as ever. Then all ranks are given the forces on all
/// common spheres (shared_motion.hpp).
class SharedBlocks {
 public:
  explicit SharedBlocks(geometry::Ranks& ranks) : ranks_(&ranks), motion_(ranks) {}

  /// Cuts the blocks of a new list, chooses who computes which, and gives each pair to the rank that
  /// has its block; all pairs to all ranks where there is nothing to share. Owners stay until the
  /// next list, as nobody else holds the rows; fill() and share_motion() have to follow.
  /// @param found  some of the pairs, others on each rank
  /// @returns the pairs of this rank, sorted
  std::vector<geometry::IndexPair> deal_out(std::span<const geometry::IndexPair> found,
                                            std::span<const SphereBody> spheres, Positions x,
                                            SphereBlocks& blocks);
  /// Fills the blocks of this rank. @param pairs, spheres, x  as they were, kinds as fill() has it
  void fill(std::span<const geometry::IndexPair> pairs, std::span<const SphereBody> spheres,
            std::span<const std::uint8_t> kinds, geometry::ThreadPool& pool, Positions x,
            SphereBlocks& blocks);
  /// The rank to which a pair that touches goes, whether it is on the list or not.
  int rank_of(const geometry::IndexPair& pair, const SphereBlocks& blocks) const noexcept;

  /// @param blocks  the same
  /// @param met     as SharedMotion::assign() has it
  void share_motion(const SphereBlocks& blocks, std::span<const NodeId> met);

  geometry::Ranks& ranks() const noexcept { return *ranks_; }
  SharedMotion& motion() noexcept { return motion_; }
  /// Whether there is anything to share: one block, or one rank, needs no message. Each rank then
  /// computes all.
  bool is_worth_it() const noexcept { return ranks_->count() > 1 && owners_.size() > 1; }
  /// The rank that has each block; empty where each has all.
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

  std::vector<geometry::IndexPair> cut_and_deal_out(std::span<const geometry::IndexPair> found,
                                                    SphereBlocks& blocks);
  void find_messages(SphereBlocks& blocks);
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
