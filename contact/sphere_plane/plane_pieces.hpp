// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/sphere_sphere/shared_motion.hpp"
#include "contact/sphere_sphere/sphere_blocks.hpp"
#include "geometry/neighbor/broad_phase.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact {

/// Which process has which spheres.
struct SphereHolders {
  const SphereBlocks* blocks = nullptr;
  std::span<const int> of_blocks;  ///< rank by block; empty: this process computes all
  SharedMotion* motion = nullptr;  ///< null where there is one process
};

/// Shares contacts of spheres with planes out into pieces, each computed by one thread. All those of
/// a sphere are in one piece, and a piece is within a block of spheres, of which ranks have whole
/// ones: what a piece comes to depends neither on the number of threads nor on that of ranks.
///
/// A rank computes the pieces of its blocks, and of others what is of common nodes, whose forces all
/// ranks find (shared_motion.hpp); the others are told of the rest where they ask.
class PlanePieces {
 public:
  /// Contacts in a piece, but for those of a last sphere with many planes.
  static constexpr std::size_t kFull = 128;

  struct Piece {
    std::uint32_t begin;  ///< in order()
    std::uint32_t end;
    std::uint32_t first;  ///< of what it comes to, by plane; see planes()
    std::uint32_t last;
    bool counts;  ///< in sums over all: elsewhere the rank that has the block counts them
  };

  /// Allocates only for a longer list than ever before.
  /// @param keys  (sphere, plane) of the contacts, sorted
  void assign(std::span<const geometry::IndexPair> keys, std::span<const SphereBody> spheres,
              const SphereHolders& holders);
  /// This process computes nothing, and all is known to all.
  void clear();

  std::span<const Piece> pieces() const noexcept { return pieces_; }
  /// The contacts that this process computes, by their places in the list.
  std::span<const std::uint32_t> order() const noexcept { return order_; }
  /// By place in order(): where in planes() its plane is.
  std::span<const std::uint32_t> sum_of() const noexcept { return sum_of_; }
  /// The planes of the pieces, each once in a piece.
  std::span<const std::int32_t> planes() const noexcept { return planes_; }

  /// Of ranks; null where all compute all.
  SharedMotion* motion() const noexcept { return motion_; }
  /// The rank that alone computes a contact; SharedMotion::kCommon where all do.
  std::int32_t teller(std::size_t contact) const noexcept {
    return tellers_.empty() ? SharedMotion::kCommon : tellers_[contact];
  }

 private:
  void sort_by_block(std::span<const geometry::IndexPair> keys, const SphereBlocks& blocks);
  void cut(std::span<const geometry::IndexPair> keys, const SphereHolders& holders);
  void add_piece(std::span<const std::uint32_t> contacts, std::span<const geometry::IndexPair> keys,
                 bool counts);

  std::vector<Piece> pieces_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> sum_of_;
  std::vector<std::int32_t> planes_;
  SharedMotion* motion_ = nullptr;
  std::vector<std::int32_t> tellers_;  ///< by contact; empty: all compute all
  std::vector<std::uint32_t> common_;  ///< of a piece
  std::vector<std::uint32_t> sorted_;  ///< contacts by block of their sphere, then as in the list
  std::vector<std::uint32_t> first_of_block_;  ///< in sorted_; the last is of no block
};

}  // namespace plekton::contact
