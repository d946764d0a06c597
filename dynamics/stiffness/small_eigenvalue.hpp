// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

namespace plekton::dynamics {

/// The largest eigenvalue, in the unit of the entries, of a symmetric matrix of one row or a few,
/// whose lower half is read. One function for all sizes: Eigen's solver is several seconds of
/// compilation for each.
double largest_eigenvalue(const Eigen::MatrixXd& symmetric);

/// The larger one of two, by Mohr's circle, for what is asked of every facet at every look at the
/// time step.
double larger_eigenvalue(const Eigen::Matrix2d& symmetric);

}  // namespace plekton::dynamics
