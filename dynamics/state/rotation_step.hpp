// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"
#include "geometry/base/small_angle.hpp"

#include <type_traits>

namespace plekton::dynamics {

/// The numbers of a quaternion in the order of Quat; Real is double or a Pack.
template <class Real>
struct QuatOf {
  Real x, y, z, w;
};

/// Orientation after turning with a constant angular velocity (rad/s, world frame) for a time (s):
/// exp(dt omega / 2) q. With packs for small turns only: geometry::cosine_and_sinc.
///
/// The product of unit quaternions leaves the unit sphere by rounding only, so one Newton step of 1
/// / |q| around 1 brings it back to the last bit, without a square root.
template <class Real>
PLEKTON_INLINE QuatOf<Real> turned_numbers(const QuatOf<Real>& q,
                                           const geometry::Vec3Of<Real>& angular_velocity,
                                           double dt) noexcept {
  using Vector = geometry::Vec3Of<Real>;
  const Vector half = Real(0.5 * dt) * angular_velocity;
  const auto [w, sinc] = geometry::cosine_and_sinc(Real(half.squaredNorm()));
  const Vector v = sinc * half;
  const Vector u{q.x, q.y, q.z};
  const Vector next = w * u + q.w * v + v.cross(u);
  const Real next_w = w * q.w - v.dot(u);
  const Real to_unit = Real(1.5) - Real(0.5) * (next.squaredNorm() + next_w * next_w);
  const Vector unit = to_unit * next;
  if constexpr (std::is_same_v<Real, double>) {
    return {unit[0], unit[1], unit[2], to_unit * next_w};
  } else {
    return {unit.x, unit.y, unit.z, to_unit * next_w};
  }
}

inline Quat turned(const Quat& orientation, const Vec3& angular_velocity, double dt) noexcept {
  const auto [x, y, z, w] = turned_numbers<double>(
      {orientation.x(), orientation.y(), orientation.z(), orientation.w()}, angular_velocity, dt);
  return {w, x, y, z};
}

}  // namespace plekton::dynamics
