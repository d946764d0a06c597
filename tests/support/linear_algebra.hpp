// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <optional>

/// Solvers of Eigen, compiled once: each is seconds of compilation wherever it is used.
namespace plekton::test {

/// Of a symmetric matrix, ascending.
Eigen::VectorXd eigenvalues_of(const Eigen::MatrixXd& symmetric);

bool is_positive_definite(const Eigen::MatrixXd& symmetric);

/// Nothing where the symmetric matrix is not positive definite.
std::optional<Eigen::VectorXd> solve_positive_definite(const Eigen::SparseMatrix<double>& matrix,
                                                       const Eigen::VectorXd& right);

/// Orthonormal basis of what is orthogonal to the rows of a matrix.
Eigen::MatrixXd kernel_of(const Eigen::MatrixXd& rows, Eigen::Index columns);

}  // namespace plekton::test
