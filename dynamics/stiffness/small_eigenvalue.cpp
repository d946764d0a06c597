// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/stiffness/small_eigenvalue.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace plekton::dynamics {

double largest_eigenvalue(const Eigen::MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[symmetric.rows() - 1];
}

// Mohr's circle: its centre and radius.
double larger_eigenvalue(const Eigen::Matrix2d& symmetric) {
  const double centre = 0.5 * (symmetric(0, 0) + symmetric(1, 1));
  const double across = 0.5 * (symmetric(0, 0) - symmetric(1, 1));
  return centre + std::sqrt(across * across + symmetric(1, 0) * symmetric(1, 0));
}

}  // namespace plekton::dynamics
