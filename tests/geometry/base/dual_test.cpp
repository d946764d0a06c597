// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/dual.hpp"

#include <gtest/gtest.h>

namespace plekton::geometry::dual_test {
namespace {

using Number = Dual<2>;

/// A formula with every operation, and its derivatives by hand.
TEST(Dual, KnowsTheDerivativesOfAFormula) {
  const double x = 1.7, y = -0.6;
  const Number a = Number::variable(x, 0);
  const Number b = Number::variable(y, 1);

  const Number f = square_root(a * a + b * b) / (a - b) - Number(3.0) * b;

  const double norm = std::sqrt(x * x + y * y);
  EXPECT_DOUBLE_EQ(f.value, norm / (x - y) - 3.0 * y);
  EXPECT_DOUBLE_EQ(f.slopes[0], x / norm / (x - y) - norm / ((x - y) * (x - y)));
  EXPECT_DOUBLE_EQ(f.slopes[1], y / norm / (x - y) + norm / ((x - y) * (x - y)) - 3.0);
}

TEST(Dual, ChainsAFunctionWhoseDerivativeIsKnown) {
  const Number f = chain(Number::variable(0.3, 1), std::sin(0.3), std::cos(0.3));
  EXPECT_EQ(f.value, std::sin(0.3));
  EXPECT_EQ(f.slopes[0], 0.0);
  EXPECT_EQ(f.slopes[1], std::cos(0.3));
}

}  // namespace
}  // namespace plekton::geometry::dual_test
