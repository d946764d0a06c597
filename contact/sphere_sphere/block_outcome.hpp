// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace plekton::contact {

/// What a step of a block of pairs came to; lane by lane, so that it does not depend on how many
/// pairs are computed at once.
template <std::size_t kLanes>
struct BlockOutcome {
  std::array<double, kLanes> dissipated;  ///< J
  std::array<double, kLanes> overlap;     ///< m, of the pair with the largest ratio of
  std::array<double, kLanes> radius;      ///< m, of its smaller sphere
  std::size_t touching = 0;

  BlockOutcome() {
    dissipated.fill(0.0);
    overlap.fill(0.0);
    radius.fill(1.0);
  }
  double total_dissipated() const noexcept {
    double total = 0.0;
    for (const double of_lane : dissipated) total += of_lane;
    return total;
  }
  /// Of overlap to the radius of the smaller sphere.
  double largest_ratio() const noexcept {
    double largest = 0.0;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      largest = std::max(largest, overlap[lane] / radius[lane]);
    return largest;
  }
};

}  // namespace plekton::contact
