// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/rigid/free_rotation.hpp"

#include "dynamics/state/rigid_nodes.hpp"
#include "dynamics/state/rotation_step.hpp"
#include "geometry/base/elementary.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace plekton::dynamics {
namespace {

constexpr std::size_t kMostTerms = 24;

/// Largest turn (rad) of a series or a step of the fourth order.
constexpr double kLongestTurn = 0.125;

/// How many parts a time is cut into, so that each turns by little.
int parts_of(double turn) noexcept {
  constexpr double kMost = 1e6;  // no motion that could be followed any more
  const double parts = std::ceil(std::abs(turn) / kLongestTurn);
  return parts > 1.0 ? static_cast<int>(std::min(parts, kMost)) : 1;
}

/// A quaternion as a scalar and a vector.
struct Turn {
  double w;
  Vec3 v;

  Turn times(const Turn& other) const noexcept {
    return {w * other.w - v.dot(other.v), w * other.v + other.w * v + v.cross(other.v)};
  }
};

/// The turn p(h) of the frame of the body.
/// @param momentum  kg m²/s, in that frame
Turn turn_by_series(const Vec3& momentum, const Vec3& moments, double h) noexcept {
  constexpr double kEnd = 0x1p-58;
  std::array<Vec3, kMostTerms> m;  // terms m_k h^k
  std::array<Vec3, kMostTerms> w;
  std::array<Turn, kMostTerms> p;
  m[0] = momentum;
  w[0] = momentum.cwiseQuotient(moments);
  p[0] = {1.0, Vec3::Zero()};
  const double m_end = kEnd * momentum.cwiseAbs().maxCoeff();
  Turn sum = p[0];
  int small = 0;
  for (std::size_t k = 0; k + 1 < kMostTerms && small < 2; ++k) {
    Vec3 m_sum = Vec3::Zero();
    Turn p_sum{0.0, Vec3::Zero()};
    for (std::size_t j = 0; j <= k; ++j) {
      m_sum += m[j].cross(w[k - j]);
      const Turn product = p[j].times({0.0, w[k - j]});
      p_sum = {p_sum.w + product.w, p_sum.v + product.v};
    }
    const double factor = h / static_cast<double>(k + 1);
    m[k + 1] = factor * m_sum;
    w[k + 1] = m[k + 1].cwiseQuotient(moments);
    p[k + 1] = {0.5 * factor * p_sum.w, (0.5 * factor) * p_sum.v};
    sum = {sum.w + p[k + 1].w, sum.v + p[k + 1].v};
    const double p_size = std::max(std::abs(p[k + 1].w), p[k + 1].v.cwiseAbs().maxCoeff());
    small = p_size <= kEnd && m[k + 1].cwiseAbs().maxCoeff() <= m_end ? small + 1 : 0;
  }
  return sum;
}

/// rad
Vec3 rotation_vector(const Turn& turn) noexcept {
  const double size = turn.v.norm();
  if (!(size > 0.0)) return 2.0 * turn.v;
  return (2.0 * elementary::atan2(size, turn.w) / size) * turn.v;
}

Turn turn_between(const Quat& from, const Quat& to) noexcept {
  const Quat turn = to * from.conjugate();
  const double sign = turn.w() < 0.0 ? -1.0 : 1.0;
  return {sign * turn.w(), sign * Vec3(turn.x(), turn.y(), turn.z())};
}

}  // namespace

Vec3 free_turn(const Vec3& momentum, const Vec3& moments, const Quat& orientation,
               double time) noexcept {
  const Mat3 axes = orientation.toRotationMatrix();
  Vec3 in_body = axes.transpose() * momentum;
  const double spin = in_body.cwiseQuotient(moments).norm();
  const int parts = parts_of(spin * time);
  Turn all{1.0, Vec3::Zero()};
  for (int i = 0; i < parts; ++i) {
    const Turn turn = turn_by_series(in_body, moments, time / parts);
    all = all.times(turn);
    const Quat back(turn.w, -turn.v.x(), -turn.v.y(), -turn.v.z());
    if (i + 1 < parts) in_body = back.normalized() * in_body;
  }
  return axes * rotation_vector(all);
}

Vec3 partly_held_spin(const Vec3& momentum, const Vec3& moments, const Quat& orientation,
                      const HeldTurning& held) noexcept {
  const Mat3 whole = inertia_in_world(moments, orientation);
  Mat3 inertia = held.is_free.asDiagonal() * whole * held.is_free.asDiagonal();
  inertia.diagonal() += Vec3::Ones() - held.is_free;
  const Vec3 free = held.is_free.cwiseProduct(Vec3(momentum - whole * held.spin));
  return held.spin + held.is_free.cwiseProduct(Vec3(inertia.inverse() * free));
}

Vec3 partly_held_turn(const Vec3& momentum, const Vec3& moments, const Quat& orientation,
                      const HeldTurning& held, double time) noexcept {
  const auto spin_at = [&](const Quat& at) {
    return partly_held_spin(momentum, moments, at, held);
  };
  const int parts = parts_of(spin_at(orientation).norm() * time);
  const double h = time / parts;
  Quat at = orientation;
  for (int i = 0; i < parts; ++i) {
    const Vec3 k1 = spin_at(at);
    const Quat half = turned(at, k1, 0.5 * h);
    const Vec3 k2 = spin_at(half);
    const Vec3 k3 = spin_at(turned(at, k2, 0.5 * h));
    const Vec3 k4 = spin_at(turned(half, Vec3(k3 - 0.5 * k1), h));
    const Vec3 first = (1.0 / 12.0) * (3.0 * k1 + 2.0 * k2 + 2.0 * k3 - k4);
    const Vec3 second = (1.0 / 12.0) * (2.0 * k2 + 2.0 * k3 - k1 + 3.0 * k4);
    at = turned(turned(at, first, h), second, h);
  }
  return rotation_vector(turn_between(orientation, at));
}

}  // namespace plekton::dynamics
