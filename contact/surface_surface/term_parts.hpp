// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_surface/pair_term.hpp"
#include "contact/surface_surface/touching_patches.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact::structure {

/// Terms in range among all there are.
struct TermsInRange {
  std::span<const std::uint32_t> acting;  ///< ascending
  std::span<const PairTerm> all;
  std::span<const Holder> holders;  ///< of all

  std::span<const Holder> holders_of(std::uint32_t term) const noexcept {
    return holders.subspan(all[term].first_holder, all[term].holder_count);
  }
};

/// The parts of the region of contact that hang together: which pairs of cells are in each, because
/// they share a feature in range, and which terms. The lower the lowest pair of a part, the lower
/// its number.
class TermParts {
 public:
  static constexpr std::int32_t kNone = -1;

  /// Almost linear in the terms in range and in the pairs.
  void find(const TermsInRange& terms, std::size_t pair_count);

  std::size_t count() const noexcept { return firsts_.empty() ? 0 : firsts_.size() - 1; }
  std::size_t pair_count() const noexcept { return parts_.size(); }
  /// kNone: the pair is not in range.
  std::int32_t part_of(std::uint32_t pair) const noexcept { return parts_[pair]; }
  /// How the cells of a pair in range go with those of the lowest pair of its part.
  Sides sides_of(std::uint32_t pair) const noexcept { return sides_[pair]; }
  /// Ascending, as places in the list of terms in range.
  std::span<const std::uint32_t> places(std::size_t part) const noexcept {
    return {places_.data() + firsts_[part], places_.data() + firsts_[part + 1]};
  }
  /// How many terms the parts before one have.
  std::size_t first(std::size_t part) const noexcept { return firsts_[part]; }

 private:
  std::size_t number_parts();

  TouchingPatches connected_;
  std::vector<std::int32_t> parts_;    ///< by pair
  std::vector<Sides> sides_;           ///< by pair
  std::vector<std::uint32_t> places_;  ///< part by part
  std::vector<std::uint32_t> firsts_;  ///< by part, and the number of all
  std::vector<std::uint32_t> next_;    ///< by part: where its next term goes
};

}  // namespace plekton::contact::structure
