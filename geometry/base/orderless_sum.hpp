// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/pack.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace plekton::geometry {

/// A sum whose bits depend neither on the order in which numbers are added nor on who adds which:
/// parts of it may be made by several threads or processes, and put together in any way.
///
/// Numbers are cut at places that are the same for all: into whole multiples of 2^(32 k), of
/// 2^(32 (k - 1)) and of 2^(32 (k - 2)), where k goes with the largest number so far; what is left
/// of a number is dropped. The multiples are added up as integers, so nothing is rounded. Of n
/// numbers of which the largest is x the sum is wrong by at most n 2^-64 |x|, beside three roundings
/// of what it comes to.
///
/// Demmel and Nguyen, Parallel reproducible summation, IEEE Trans. Comput. 64 (2015) 2060-2070.
class OrderlessSum {
 public:
  /// Beyond it (1e298) a number counts as infinite.
  static constexpr int kLargestExponent = 990;

  void add(double number) noexcept { add<1>(&number, 1); }

  /// Adds numbers W at a time.
  /// @param count  a multiple of W, at most 2^20
  template <int W>
  PLEKTON_INLINE void add(const double* numbers, std::size_t count) noexcept {
    using Real = Pack<W>;
    constexpr auto kWidth = static_cast<std::size_t>(W);
    Real largest = 0.0, nothing = 0.0;
    for (std::size_t i = 0; i < count; i += kWidth) {
      const Real x = Real::load(numbers + i);
      largest = larger_of(select(x > Real(0.0), x, -x), largest);
      nothing = nothing + Real(0.0) * x;
    }
    if (!begin(in_lanes<W>(largest), in_lanes<W>(nothing))) return;
    const std::array<double, kParts> unit = units();
    std::array<Real, kParts> sums{Real(0.0), Real(0.0), Real(0.0)};
    for (std::size_t i = 0; i < count; i += kWidth) {
      Real x = Real::load(numbers + i);
      for (std::size_t part = 0; part < kParts; ++part) {
        const Real rounding = kRounding * unit[part];
        const Real whole = (x + rounding) - rounding;
        sums[part] = sums[part] + whole;
        x = x - whole;
      }
    }
    for (std::size_t part = 0; part < kParts; ++part) {
      for (const double sum : in_lanes<W>(sums[part]))
        counts_[part] += static_cast<std::int64_t>(sum / unit[part]);
    }
  }

  OrderlessSum& operator+=(OrderlessSum other) noexcept {
    if (other.top_ < top_) other.raise(top_);
    raise(other.top_);
    for (std::size_t part = 0; part < kParts; ++part) counts_[part] += other.counts_[part];
    is_finite_ = is_finite_ && other.is_finite_;
    return *this;
  }

  /// NaN if any number was not finite.
  double value() const noexcept;

 private:
  static constexpr std::size_t kParts = 3;
  static constexpr int kBits = 32;  ///< of a number in each part, but for its sign
  static constexpr std::int32_t kLowest = -31;
  /// Adding it to a number and taking it off again leaves the nearest multiple of the unit, as the
  /// last place of the sum is worth one.
  static constexpr double kRounding = 0x1.8p52;

  template <int W>
  PLEKTON_INLINE static std::array<double, std::size_t{W}> in_lanes(const Pack<W>& pack) noexcept {
    std::array<double, std::size_t{W}> lanes;
    pack.store(lanes.data());
    return lanes;
  }

  /// Makes room for numbers up to the largest of some.
  /// @param nothing  0 where numbers were finite
  /// @returns whether there is anything to add
  template <std::size_t W>
  bool begin(const std::array<double, W>& largest, const std::array<double, W>& nothing) noexcept {
    double most = 0.0;
    for (std::size_t lane = 0; lane < W; ++lane) {
      if (largest[lane] > most) most = largest[lane];
      if (!(nothing[lane] == 0.0)) is_finite_ = false;
    }
    return is_finite_ && most > 0.0 && make_room(most);
  }

  bool make_room(double largest) noexcept;
  void raise(std::int32_t top) noexcept;
  std::array<double, kParts> units() const noexcept;

  std::int32_t top_ = kLowest;  ///< k
  std::int32_t is_finite_ = 1;
  std::array<std::int64_t, kParts> counts_{};  ///< multiples, of the largest unit first
};

}  // namespace plekton::geometry
