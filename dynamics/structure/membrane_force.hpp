// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::dynamics {

/// Membrane forces across the two cuts of a facet on which there is no shear (N/m), tension
/// positive.
struct PrincipalForces {
  double largest = 0.0;
  double smallest = 0.0;
};

/// @param force  N/m, symmetric, nothing along the normal: its trace is the sum of the two, its
///               squared norm the sum of their squares
inline PrincipalForces principal_forces(const geometry::Mat3& force) noexcept {
  const double sum = force.trace();
  const double difference = std::sqrt(std::max(0.0, 2.0 * force.squaredNorm() - sum * sum));
  return {0.5 * (sum + difference), 0.5 * (sum - difference)};
}

}  // namespace plekton::dynamics
