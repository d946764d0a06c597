// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/motion_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plekton::dynamics {

double largest_speed(const NodeState& state) noexcept {
  double squared = 0.0;
  for (const Vec3& velocity : state.velocity) squared = std::max(squared, velocity.squaredNorm());
  return std::sqrt(squared);
}

// With c = kStepsBetweenLooks gravity and s = kLargestMotion radius the positive root of
// c dt² + speed dt = s, in the form that does not cancel where c is small.
double longest_step(double speed, double gravity, double radius) noexcept {
  const double reach = kLargestMotion * radius;
  const double growth = static_cast<double>(kStepsBetweenLooks) * gravity;
  const double root = std::sqrt(speed * speed + 4.0 * growth * reach);
  if (!(speed + root > 0.0) || !std::isfinite(root)) return std::numeric_limits<double>::infinity();
  return 2.0 * reach / (speed + root);
}

}  // namespace plekton::dynamics
