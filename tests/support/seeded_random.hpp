// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <cmath>
#include <cstdint>
#include <random>

/// Random numbers for tests: the same sequence with any standard library.
namespace plekton::test {

using geometry::Mat3;
using geometry::Quat;
using geometry::Vec3;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// In [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * unit(); }
  /// From low to high, both included.
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  std::size_t index(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }
  bool coin() { return (engine_() & 1U) != 0; }
  /// 10 to a uniform power, with a random sign.
  double signed_power(double low, double high) {
    return (coin() ? 1.0 : -1.0) * std::pow(10.0, uniform(low, high));
  }

  Vec3 in_cube(double half_side) {
    const double x = uniform(-half_side, half_side);
    const double y = uniform(-half_side, half_side);
    return {x, y, uniform(-half_side, half_side)};
  }
  Vec3 on_lattice(int low, int high) {
    const int x = integer(low, high);
    const int y = integer(low, high);
    return Vec3(x, y, integer(low, high));
  }
  Vec3 direction() {
    while (true) {
      const Vec3 v = in_cube(1.0);
      if (v.squaredNorm() < 1.0 && v.squaredNorm() > 0.01) return v.normalized();
    }
  }
  Mat3 rotation() {
    const Vec3 axis = direction();
    return Eigen::AngleAxisd(uniform(0.0, 6.28), axis).toRotationMatrix();
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace plekton::test
