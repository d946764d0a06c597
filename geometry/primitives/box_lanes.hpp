// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/pack.hpp"
#include "geometry/base/types.hpp"

#include <array>
#include <cstdint>
#include <limits>

namespace plekton::geometry {

/// Up to 8 boxes side by side, so that one is compared with all of them at once.
struct alignas(64) BoxLanes {
  static constexpr std::size_t kLanes = 8;
  using Row = std::array<double, kLanes>;

  std::array<Row, 3> lower;                ///< m, by axis
  std::array<Row, 3> upper;                ///< m, by axis
  std::array<std::int32_t, kLanes> index;  ///< of the boxes, for the caller

  /// Lanes without a box overlap nothing.
  void clear() noexcept {
    for (Row& row : lower) row.fill(std::numeric_limits<double>::max());
    for (Row& row : upper) row.fill(std::numeric_limits<double>::lowest());
    index.fill(-1);
  }
  void set(std::size_t lane, const Vec3& least, const Vec3& greatest,
           std::int32_t of_box) noexcept {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lower[axis][lane] = least[static_cast<int>(axis)];
      upper[axis][lane] = greatest[static_cast<int>(axis)];
    }
    index[lane] = of_box;
  }

  /// Bit l tells whether box l overlaps another one; touching counts. Nothing may be infinite or
  /// NaN.
  template <int W>
  PLEKTON_INLINE unsigned overlaps(const Vec3& least, const Vec3& greatest) const noexcept {
    unsigned bits = 0;
    for (std::size_t lane = 0; lane < kLanes; lane += std::size_t{W}) {
      // The sign of a difference is exact: boxes are apart if the largest of six is positive.
      Pack<W> apart = std::numeric_limits<double>::lowest();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Pack<W> below = Pack<W>::load(&lower[axis][lane]) - greatest[static_cast<int>(axis)];
        const Pack<W> above = least[static_cast<int>(axis)] - Pack<W>::load(&upper[axis][lane]);
        apart = larger_of(apart, larger_of(below, above));
      }
      bits |= bits_of(flag(Pack<W>(0.0) >= apart)) << lane;
    }
    return bits;
  }
};

}  // namespace plekton::geometry
