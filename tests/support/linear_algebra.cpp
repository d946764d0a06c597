// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/linear_algebra.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <Eigen/SparseCholesky>

#include <algorithm>

namespace plekton::test {

Eigen::VectorXd eigenvalues_of(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

bool is_positive_definite(const Eigen::MatrixXd& symmetric) {
  return Eigen::LLT<Eigen::MatrixXd>(symmetric).info() == Eigen::Success;
}

std::optional<Eigen::VectorXd> solve_positive_definite(const Eigen::SparseMatrix<double>& matrix,
                                                       const Eigen::VectorXd& right) {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success || solver.vectorD().minCoeff() <= 0.0) return std::nullopt;
  return solver.solve(right);
}

Eigen::MatrixXd kernel_of(const Eigen::MatrixXd& rows, Eigen::Index columns) {
  if (columns == 0) return Eigen::MatrixXd(0, 0);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullV);
  const double least = 1e-9 * std::max(1e-300, svd.singularValues()[0]);
  const Eigen::Index rank = (svd.singularValues().array() > least).count();
  return svd.matrixV().rightCols(columns - rank);
}

}  // namespace plekton::test
