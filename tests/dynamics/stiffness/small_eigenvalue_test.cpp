// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/stiffness/small_eigenvalue.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plekton::test::small_eigenvalue_test {
namespace {

/// The values on the diagonal, seen from axes that a mirror has turned (Householder).
Eigen::MatrixXd mirrored(const Eigen::VectorXd& values, Random& random) {
  const Eigen::Index size = values.size();
  const Eigen::VectorXd across =
      Eigen::VectorXd::NullaryExpr(size, [&] { return random.uniform(0.1, 1.0); }).normalized();
  const Eigen::MatrixXd mirror =
      Eigen::MatrixXd::Identity(size, size) - 2.0 * across * across.transpose();
  return mirror * values.asDiagonal() * mirror;
}

TEST(SmallEigenvalue, IsTheLargestOfAnySize) {
  Random random(1);
  for (Eigen::Index size = 1; size <= 9; ++size) {
    for (int trial = 0; trial < 50; ++trial) {
      const Eigen::VectorXd values =
          Eigen::VectorXd::NullaryExpr(size, [&] { return random.uniform(-1.0, 1.0); });
      // Rounding of two products and of the tridiagonal form: some size² units of the largest.
      const double rounding = 1e2 * std::numeric_limits<double>::epsilon();
      EXPECT_NEAR(dynamics::largest_eigenvalue(mirrored(values, random)), values.maxCoeff(),
                  rounding);
    }
  }
}

TEST(SmallEigenvalue, OfNothingIsNothing) {
  EXPECT_EQ(dynamics::largest_eigenvalue(Eigen::MatrixXd::Zero(6, 6)), 0.0);
  EXPECT_EQ(dynamics::larger_eigenvalue(Eigen::Matrix2d::Zero()), 0.0);
}

TEST(SmallEigenvalue, OfTwoIsThatOfAnyNumber) {
  Random random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    Eigen::Matrix2d matrix;
    matrix(0, 0) = random.uniform(-1.0, 1.0);
    matrix(1, 1) = random.uniform(-1.0, 1.0);
    matrix(0, 1) = matrix(1, 0) = random.uniform(-1.0, 1.0);
    EXPECT_NEAR(dynamics::larger_eigenvalue(matrix), dynamics::largest_eigenvalue(matrix),
                16 * std::numeric_limits<double>::epsilon());
  }
}

TEST(SmallEigenvalue, OfTwoEqualOnesIsThatOne) {
  EXPECT_EQ(dynamics::larger_eigenvalue(3.0 * Eigen::Matrix2d::Identity()), 3.0);
}

}  // namespace
}  // namespace plekton::test::small_eigenvalue_test
