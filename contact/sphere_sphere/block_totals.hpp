// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/sphere_sphere/block_outcome.hpp"
#include "geometry/base/orderless_sum.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace plekton::contact {

/// What a step of any number of blocks came to, put together in any order.
struct BlockTotals {
  geometry::OrderlessSum dissipated;  ///< J
  double largest_ratio = 0.0;         ///< of overlap to the radius of the smaller sphere
  std::uint64_t touching = 0;         ///< pairs

  template <std::size_t kLanes>
  void add(const BlockOutcome<kLanes>& outcome) noexcept {
    dissipated.add(outcome.total_dissipated());
    largest_ratio = std::max(largest_ratio, outcome.largest_ratio());
    touching += outcome.touching;
  }
  BlockTotals& operator+=(const BlockTotals& other) noexcept {
    dissipated += other.dissipated;
    largest_ratio = std::max(largest_ratio, other.largest_ratio);
    touching += other.touching;
    return *this;
  }
};

}  // namespace plekton::contact
