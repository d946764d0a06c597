// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <cstdint>
#include <random>
#include <utility>

namespace plekton::apps {

/// Random numbers that are the same with every standard library: the engine is defined by the
/// standard, the distributions of the standard library are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// In [0, 1), a multiple of 2^-53.
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * unit(); }

  /// Uniform in the box between two corners.
  geometry::Vec3 in_box(const geometry::Vec3& lower, const geometry::Vec3& upper) {
    const double x = uniform(lower[0], upper[0]);
    const double y = uniform(lower[1], upper[1]);
    return {x, y, uniform(lower[2], upper[2])};
  }

  /// Puts the items into a random order (Fisher and Yates). The modulo favours no order noticeably
  /// below 2^40 items.
  template <class Items>
  void shuffle(Items& items) {
    for (std::size_t n = items.size(); n > 1; --n) std::swap(items[n - 1], items[engine_() % n]);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace plekton::apps
