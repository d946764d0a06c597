// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/node_state.hpp"

#include <cmath>

namespace plekton::dynamics {

/// Unit quaternion of a rotation vector (rad): exp(v / 2).
///
/// Below half an angle of 0.1 the series of sin(h) / h and cos(h) to h^8 are exact to 1e-18; they save two calls of the
/// mathematical library for every node in every step.
inline Quat rotation_of(const Vec3& vector) noexcept {
  const Vec3 half = 0.5 * vector;
  const double h2 = half.squaredNorm();
  double sinc = 0.0;
  double cosine = 0.0;
  if (h2 < 0.01) {
    sinc = 1.0 - h2 / 6.0 * (1.0 - h2 / 20.0 * (1.0 - h2 / 42.0 * (1.0 - h2 / 72.0)));
    cosine = 1.0 - h2 / 2.0 * (1.0 - h2 / 12.0 * (1.0 - h2 / 30.0 * (1.0 - h2 / 56.0 * (1.0 - h2 / 90.0))));
  } else {
    const double h = std::sqrt(h2);
    sinc = std::sin(h) / h;
    cosine = std::cos(h);
  }
  return Quat(cosine, sinc * half[0], sinc * half[1], sinc * half[2]);
}

/// Orientation after turning with a constant angular velocity (rad/s, world frame) for a time (s); normalised.
inline Quat turned(const Quat& orientation, const Vec3& angular_velocity, double dt) noexcept {
  return (rotation_of(dt * angular_velocity) * orientation).normalized();
}

}  // namespace plekton::dynamics
