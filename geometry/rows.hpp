// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/pack.hpp"

#include <cstddef>
#include <cstring>

namespace plekton::geometry {

/// Rows for up to Lanes things that consist of kNumbers doubles each: number n of all things is row
/// n.
template <std::size_t kNumbers, std::size_t kLanes>
class Rows {
 public:
  /// Writes a thing into a lane.
  template <class Thing>
  PLEKTON_INLINE void set(std::size_t lane, const Thing& thing) noexcept {
    static_assert(sizeof(Thing) == kNumbers * sizeof(double));
    const auto* numbers = reinterpret_cast<const double*>(&thing);
    for (std::size_t n = 0; n < kNumbers; ++n) rows_[n][lane] = numbers[n];
  }

  template <class Thing>
  PLEKTON_INLINE void get(std::size_t lane, Thing& thing) const noexcept {
    static_assert(sizeof(Thing) == kNumbers * sizeof(double));
    auto* numbers = reinterpret_cast<double*>(&thing);
    for (std::size_t n = 0; n < kNumbers; ++n) numbers[n] = rows_[n][lane];
  }

  /// The first number of a lane.
  PLEKTON_INLINE double number(std::size_t lane) const noexcept { return rows_[0][lane]; }

  /// The same thing of W lanes side by side.
  template <class Packs>
  PLEKTON_INLINE Packs load(std::size_t lane) const noexcept {
    constexpr std::size_t kBytes = sizeof(Packs) / kNumbers;
    Packs packs;
    for (std::size_t n = 0; n < kNumbers; ++n) {
      std::memcpy(reinterpret_cast<char*>(&packs) + n * kBytes, &rows_[n][lane], kBytes);
    }
    return packs;
  }

  template <class Packs>
  PLEKTON_INLINE void store(std::size_t lane, const Packs& packs) noexcept {
    constexpr std::size_t kBytes = sizeof(Packs) / kNumbers;
    for (std::size_t n = 0; n < kNumbers; ++n) {
      std::memcpy(&rows_[n][lane], reinterpret_cast<const char*>(&packs) + n * kBytes, kBytes);
    }
  }

 private:
  alignas(64) double rows_[kNumbers][kLanes];
};

template <class Thing, std::size_t kLanes>
using RowsOf = Rows<sizeof(Thing) / sizeof(double), kLanes>;

}  // namespace plekton::geometry
