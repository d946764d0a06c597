// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_surface/term_parts.hpp"
#include "geometry/base/thread_pool.hpp"

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
class CycleSearch {
 public:
  /// Almost linear in the terms in range, but for their order by overlap; each part by itself.
  /// Keeps its working space, so that a warm call does not allocate.
  /// @param parts       of the terms
  /// @param are_new     whether terms or parts are others than those of the last call
  /// @param least_life  m: terms whose overlaps differ by no more are on one level. Rounding makes
  ///                    the order of features that stand at one place, and a hole that is there
  ///                    over no more than rounding gives back nothing (CycleWeights::kLeastLife)
  /// @returns such parts, ascending
  std::span<const std::uint32_t> find(const TermsInRange& terms, const TermParts& parts,
                                      bool are_new, double least_life, geometry::ThreadPool& pool);

 private:
  /// A term in range, side by side with what it is sorted by.
  struct Level {
    double overlap;
    std::uint32_t term;
  };

  void put_in_parts(const TermsInRange& terms, const TermParts& parts);
  bool is_more(const TermsInRange& terms, std::span<Level> levels, double least_life,
               std::uint32_t* changed);
  std::uint32_t part_at_level(std::uint32_t pair) const noexcept {
    while (root_[pair] != pair) pair = root_[pair];
    return pair;
  }
  std::uint32_t unite(std::span<const Holder> holders) noexcept;
  bool are_pieces(std::span<const std::uint32_t> changed) const noexcept;

  std::vector<Level> order_;                  ///< terms in range, part by part, each deepest first
  std::vector<Level> last_;                   ///< of the parts before
  std::vector<std::int32_t> parts_of_terms_;  ///< by term; all TermParts::kNone between calls
  std::vector<std::size_t> next_;             ///< by part: where its next term goes
  /// By pair: the lowest that it hangs together with, or one on the way there.
  std::vector<std::uint32_t> root_;
  std::vector<std::int32_t> sums_;  ///< by such a lowest pair: Euler's number
  /// As order_: pairs, one of each piece that changes at a level.
  std::vector<std::uint32_t> changed_;
  std::vector<char> are_more_;  ///< by part
  std::vector<std::uint32_t> found_;
};

}  // namespace plekton::contact::structure
