// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/search/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace plekton::benchmarks {
namespace {

using geometry::Vec3;

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Both halves of a square of a grid.
void add_square(Shape& shape, std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
  shape.facets.push_back({a, b, c});
  shape.facets.push_back({a, c, d});
}

int squares_a_side(int facets) {
  return std::max(3, static_cast<int>(std::lround(std::sqrt(0.5 * facets))));
}

}  // namespace

Shape rippled_ring(int facets) {
  Shape shape;
  const int n = squares_a_side(facets);
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      const double around = kTurn * i / n, across = kTurn * k / n;
      const double thin = 0.3 + 0.02 * std::sin(9.0 * around) * std::cos(5.0 * across);
      const double radius = 1.0 + thin * std::cos(across);
      shape.points.emplace_back(radius * std::cos(around), radius * std::sin(around),
                                thin * std::sin(across));
    }
  }
  const auto at = [n](int i, int k) { return (i % n) * n + k % n; };
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k)
      add_square(shape, at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
  }
  return shape;
}

Shape sheet(int facets, double height) {
  Shape shape;
  const int n = squares_a_side(facets);
  for (int i = 0; i <= n; ++i) {
    for (int k = 0; k <= n; ++k) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(k) / n;
      shape.points.emplace_back(x, y, height * std::sin(2.0 * kTurn * x) * std::cos(kTurn * y));
    }
  }
  const auto at = [n](int i, int k) { return i * (n + 1) + k; };
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k)
      add_square(shape, at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
  }
  return shape;
}

Shape placed(Shape shape, double angle, const Vec3& way) {
  const geometry::Mat3 turn = Eigen::AngleAxisd(angle, Vec3(0.48, 0.6, 0.64)).toRotationMatrix();
  for (Vec3& x : shape.points) x = turn * x + way;
  return shape;
}

}  // namespace plekton::benchmarks
