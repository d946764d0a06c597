// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/pack.hpp"

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
    double numbers[kNumbers];  // a thing may hold more than doubles: copied as it is
    std::memcpy(numbers, &thing, sizeof(thing));
    for (std::size_t n = 0; n < kNumbers; ++n) rows_[n][lane] = numbers[n];
  }

  template <class Thing>
  PLEKTON_INLINE void get(std::size_t lane, Thing& thing) const noexcept {
    static_assert(sizeof(Thing) == kNumbers * sizeof(double));
    double numbers[kNumbers];
    for (std::size_t n = 0; n < kNumbers; ++n) numbers[n] = rows_[n][lane];
    std::memcpy(static_cast<void*>(&thing), numbers, sizeof(thing));
  }

  template <class Thing>
  PLEKTON_INLINE Thing at(std::size_t lane) const noexcept {
    Thing thing;
    get(lane, thing);
    return thing;
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

  /// The same in the lanes whose flag is 1, and 0 in the others.
  template <class Packs, int W>
  PLEKTON_INLINE void store(std::size_t lane, const Packs& packs, const Pack<W>& flags) noexcept {
    static_assert(sizeof(Packs) == kNumbers * sizeof(Pack<W>));
    for (std::size_t n = 0; n < kNumbers; ++n) {
      Pack<W> pack;
      std::memcpy(&pack, reinterpret_cast<const char*>(&packs) + n * sizeof(pack), sizeof(pack));
      select(flags > 0.0, pack, 0.0).store(&rows_[n][lane]);
    }
  }

 private:
  alignas(64) double rows_[kNumbers][kLanes];
};

template <class Thing, std::size_t kLanes>
using RowsOf = Rows<sizeof(Thing) / sizeof(double), kLanes>;

}  // namespace plekton::geometry
