// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/largest_eigenvalue.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace plekton::dynamics::largest_eigenvalue_test {
namespace {

/// Of a ball on a wall: along the normal, and two that slide and turn. Only three of its six
/// eigenvalues differ, so that Lanczos' vectors span all there is before they are six.
/// @param normal, tangential  1/s², stiffness over mass
Eigen::MatrixXd ball_on_wall(double normal, double tangential) {
  const double turn = std::sqrt(2.5);  // radius over that of gyration
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(6, 6);
  matrix(2, 2) = normal;
  for (const auto& [slides, turns, sign] : {std::tuple(0, 4, -1.0), std::tuple(1, 3, 1.0)}) {
    matrix(slides, slides) = tangential;
    matrix(slides, turns) = matrix(turns, slides) = sign * tangential * turn;
    matrix(turns, turns) = tangential * turn * turn;
  }
  return matrix;
}

TEST(LargestEigenvalue, IsThatOfASphereOnAWallWhateverItsStiffness) {
  for (const double normal : {1e-8, 1.0, 1e8, 1e16}) {
    for (int k = 0; k < 1000; ++k) {
      const double tangential = normal * (0.1 + 1e-3 * k);
      const Eigen::MatrixXd matrix = ball_on_wall(normal, tangential);
      const auto product = [&](const Eigen::VectorXd& x, Eigen::VectorXd& y) { y = matrix * x; };

      const LargestEigenvalue found = largest_eigenvalue({6, product}, 1e-3, 300);

      const double expected = std::max(normal, 3.5 * tangential);
      ASSERT_NEAR(found.value / expected, 1.0, 1e-12) << normal << ' ' << k;
    }
  }
}

}  // namespace
}  // namespace plekton::dynamics::largest_eigenvalue_test
