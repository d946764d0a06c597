// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_surface/pair_term.hpp"
#include "contact/surface_surface/wrapped_joints.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact::structure {

/// Which parts of the region of contact are more than pieces at some level.
///
/// The weights of the terms nearer than a level add up to Euler's number of what is nearer
/// (geometry/critical/product_features.hpp): to 1 for each piece, less its holes. So where they
/// add up to 1 over every part that hangs together, at every level, there are pieces alone. Voids
/// count for 1 more, but a void that begins before a hole does is seen as well.
class RingSearch {
 public:
  /// Almost linear in the terms in range, but for their order by overlap. Keeps its working space,
  /// so that a warm call does not allocate.
  /// @param acting      terms in range, ascending
  /// @param holders     of all terms
  /// @param pair_count  of all pairs of cells
  /// @param least_life  m: terms whose overlaps differ by no more are on one level. Rounding makes
  ///                    the order of features that stand at one place, and a hole that is there
  ///                    over no more than rounding gives back nothing (RingWeights::kLeastLife)
  /// @returns whether there is such a part
  bool find(std::span<const std::uint32_t> acting, std::span<const PairTerm> terms,
            std::span<const Holder> holders, std::size_t pair_count, double least_life);

  /// Pairs of cells of such parts, part after part: of one ascending, the lowest first. Of the last
  /// find(), as the next.
  std::span<const std::uint32_t> pairs() const noexcept { return pairs_; }
  /// The lowest pair of the part that one is in.
  std::uint32_t part_of(std::uint32_t pair) const noexcept {
    while (root_[pair] != pair) pair = root_[pair];
    return pair;
  }
  bool is_more(std::uint32_t part) const noexcept { return is_more_[part] != 0; }

 private:
  void sort(std::span<const std::uint32_t> acting, std::span<const PairTerm> terms);
  std::uint32_t unite(std::span<const Holder> holders) noexcept;
  void check_level() noexcept;

  /// A term in range, side by side with what it is sorted by.
  struct Level {
    double overlap;
    std::uint32_t term;
  };

  std::vector<Level> order_;            ///< terms in range, deepest first
  std::vector<char> is_new_;            ///< by term; all 0 between calls
  std::vector<std::uint32_t> root_;     ///< by pair: the lowest of its part, or one on the way
  std::vector<std::int32_t> sums_;      ///< by part: Euler's number
  std::vector<char> is_more_;           ///< by part: than a piece, at some level
  std::vector<std::uint32_t> changed_;  ///< pairs, one of each part that changes at a level
  std::vector<std::uint32_t> pairs_;
  bool found_ = false;
};

}  // namespace plekton::contact::structure
