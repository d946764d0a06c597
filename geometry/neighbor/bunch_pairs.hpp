// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/neighbor/broad_phase.hpp"
#include "geometry/primitives/box_lanes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

namespace plekton::geometry {

/// Lists the pairs within a tree, or between two of them, bunch by bunch.
///
/// @tparam Tree  has Place, kMaxHeight, child(place, 0 or 1), box(place) with min_ and max_,
///               overlap(box, box), and bunch(place): the bunch that a leaf is, or nullptr
/// @tparam kOneTree  whether both trees are the same: pairs have the lower index first
template <int W, class Tree, bool kOneTree>
class BunchPairs {
 public:
  using Place = typename Tree::Place;

  BunchPairs(const Tree& p, const Tree& q, std::vector<IndexPair>& pairs)
      : p_(p), q_(q), pairs_(pairs) {}

  /// Of boxes below a node of the one tree with boxes below a node of the other.
  PLEKTON_INLINE void across(Place below_p, Place below_q) {
    std::array<std::array<Place, 2>, 3 * Tree::kMaxHeight + 4> waiting;
    std::size_t count = 0;
    const auto add = [&](Place x, Place y) __attribute__((always_inline)) {
      waiting[count] = {x, y};
      count += Tree::overlap(p_.box(x), q_.box(y));
    };
    add(below_p, below_q);
    while (count > 0) {
      const auto [x, y] = waiting[--count];
      const BoxLanes* const p = p_.bunch(x);
      const BoxLanes* const q = q_.bunch(y);
      if (p && q) {
        between(*p, p_.box(x), *q, q_.box(y));
      } else if (p) {
        for (std::size_t k = 0; k < 2; ++k) add(x, q_.child(y, k));
      } else if (q) {
        for (std::size_t k = 0; k < 2; ++k) add(p_.child(x, k), y);
      } else {
        for (std::size_t k = 0; k < 4; ++k) add(p_.child(x, k / 2), q_.child(y, k % 2));
      }
    }
  }

  PLEKTON_INLINE void within(const BoxLanes& bunch) {
    for (std::size_t lane = 0; lane < BoxLanes::kLanes; ++lane)
      emit(bunch, lane, bunch, overlaps(bunch, lane, bunch) & (~1U << lane));
  }

 private:
  /// Most boxes of either bunch are away from all of the other.
  PLEKTON_INLINE void between(const BoxLanes& p, const auto& all_of_p, const BoxLanes& q,
                              const auto& all_of_q) {
    unsigned of_p = p.template overlaps<W>(all_of_q.min_, all_of_q.max_);
    if (q.template overlaps<W>(all_of_p.min_, all_of_p.max_) == 0) return;
    for (; of_p != 0; of_p &= of_p - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(of_p));
      emit(p, lane, q, overlaps(p, lane, q));
    }
  }

  PLEKTON_INLINE static unsigned overlaps(const BoxLanes& p, std::size_t lane, const BoxLanes& q) {
    return q.template overlaps<W>(Vec3{p.lower[0][lane], p.lower[1][lane], p.lower[2][lane]},
                                  Vec3{p.upper[0][lane], p.upper[1][lane], p.upper[2][lane]});
  }

  PLEKTON_INLINE void emit(const BoxLanes& p, std::size_t lane, const BoxLanes& q, unsigned bits) {
    const std::int32_t i = p.index[lane];
    for (; bits != 0; bits &= bits - 1) {
      const std::int32_t j = q.index[static_cast<std::size_t>(std::countr_zero(bits))];
      pairs_.push_back(kOneTree ? IndexPair{std::min(i, j), std::max(i, j)} : IndexPair{i, j});
    }
  }

  const Tree& p_;
  const Tree& q_;
  std::vector<IndexPair>& pairs_;
};

}  // namespace plekton::geometry
