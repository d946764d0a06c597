// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

namespace plekton::dynamics {

/// The largest eigenvalue of a symmetric matrix of a few rows, whose lower half is read. One
/// function for all sizes: Eigen's solver is several seconds of compilation for each.
double largest_eigenvalue(const Eigen::MatrixXd& symmetric);

/// The larger one of two, for what is asked of every facet in every step.
double larger_eigenvalue(const Eigen::Matrix2d& symmetric);

}  // namespace plekton::dynamics
