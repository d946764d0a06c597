// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/copy_bits.hpp"
#include "geometry/base/pack.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace plekton::geometry {

/// Rows of kLanes numbers each, for things that consist of doubles: number n of all things is row
/// n, so that things side by side are read and written by whole vectors. A view; how many numbers a
/// thing has may be known at run time only.
/// @tparam Number  double, or const double of rows that are only read
template <std::size_t kLanes, class Number = double>
class LaneRows {
  /// The last one maybe in part.
  template <class Thing>
  static constexpr std::size_t kNumbersOf = (sizeof(Thing) + sizeof(double) - 1) / sizeof(double);

 public:
  /// @param first  of row_count * kLanes numbers
  explicit LaneRows(Number* first) noexcept : first_(first) {}

  /// The rows from number n of the things on.
  LaneRows from(std::size_t n) const noexcept { return LaneRows(first_ + n * kLanes); }

  /// The first number of all lanes.
  Number* numbers() const noexcept { return first_; }

  /// Writes so many numbers into a lane.
  PLEKTON_INLINE void set_numbers(std::size_t lane, const double* numbers,
                                  std::size_t count) const noexcept {
    for (std::size_t n = 0; n < count; ++n) first_[n * kLanes + lane] = numbers[n];
  }
  PLEKTON_INLINE void get_numbers(std::size_t lane, double* numbers,
                                  std::size_t count) const noexcept {
    for (std::size_t n = 0; n < count; ++n) numbers[n] = first_[n * kLanes + lane];
  }

  /// Writes a thing into a lane.
  template <class Thing>
  PLEKTON_INLINE void set(std::size_t lane, const Thing& thing) const noexcept {
    std::array<double, kNumbersOf<Thing>> numbers{};
    copy_bits(thing, numbers.data());
    set_numbers(lane, numbers.data(), numbers.size());
  }
  template <class Thing>
  PLEKTON_INLINE Thing at(std::size_t lane) const noexcept {
    std::array<double, kNumbersOf<Thing>> numbers;
    get_numbers(lane, numbers.data(), numbers.size());
    Thing thing;
    std::memcpy(static_cast<void*>(&thing), numbers.data(), sizeof thing);
    return thing;
  }
  /// The first number of a lane.
  PLEKTON_INLINE double number(std::size_t lane) const noexcept { return first_[lane]; }

  /// The same thing of W lanes side by side.
  template <class Packs, int W>
  PLEKTON_INLINE Packs load(std::size_t lane) const noexcept {
    Packs packs;
    for (std::size_t n = 0; n < sizeof(Packs) / sizeof(Pack<W>); ++n)
      std::memcpy(static_cast<void*>(byte_of<W>(packs, n)), first_ + n * kLanes + lane,
                  sizeof(Pack<W>));
    return packs;
  }
  template <int W, class Packs>
  PLEKTON_INLINE void store(std::size_t lane, const Packs& packs) const noexcept {
    for (std::size_t n = 0; n < sizeof(Packs) / sizeof(Pack<W>); ++n)
      std::memcpy(first_ + n * kLanes + lane, byte_of<W>(packs, n), sizeof(Pack<W>));
  }
  /// The same in the lanes whose flag is 1, and 0 in the others.
  template <int W, class Packs>
  PLEKTON_INLINE void store(std::size_t lane, const Packs& packs,
                            const Pack<W>& flags) const noexcept {
    for (std::size_t n = 0; n < sizeof(Packs) / sizeof(Pack<W>); ++n) {
      Pack<W> pack;
      std::memcpy(static_cast<void*>(&pack), byte_of<W>(packs, n), sizeof(pack));
      select(flags > 0.0, pack, 0.0).store(first_ + n * kLanes + lane);
    }
  }

 private:
  /// Where pack n of some begins.
  template <int W, class Packs>
  PLEKTON_INLINE static auto byte_of(Packs& packs, std::size_t n) noexcept {
    using Byte = std::conditional_t<std::is_const_v<Packs>, const std::byte, std::byte>;
    return reinterpret_cast<Byte*>(&packs) + n * sizeof(Pack<W>);
  }

  Number* first_;
};

}  // namespace plekton::geometry
