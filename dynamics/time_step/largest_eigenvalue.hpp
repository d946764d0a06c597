// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <functional>

namespace plekton::dynamics {

/// A symmetric matrix by its products.
struct SymmetricProduct {
  Eigen::Index size;
  /// Sets y, which has the size already, to the matrix times x.
  std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& y)> multiply;
};

struct LargestEigenvalue {
  double value = 0.0;     ///< its magnitude; never above the true one but for rounding
  double residual = 0.0;  ///< an eigenvalue lies no further than this from value
  int products = 0;
};

/// Eigenvalue of the largest magnitude by Lanczos' method: power iteration that keeps what all its
/// products have told, so that it needs about the square root of their number. It starts from the
/// same vector of pseudo-random numbers every time.
///
/// After k products the relative error is on average below 0.11 (ln(n (k - 1)) / (k - 1))² for a
/// random start (Kuczynski & Wozniakowski, SIAM J. Matrix Anal. Appl. 13 (1992), theorem 3.2),
/// however close the eigenvalues lie, and falls much faster where they do not.
/// @param tolerance  of the residual over the value; it ends there, or after most_products
LargestEigenvalue largest_eigenvalue(const SymmetricProduct& matrix, double tolerance,
                                     int most_products);

}  // namespace plekton::dynamics
