// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/counting/wrap.hpp"

#include "geometry/base/elementary.hpp"

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace plekton::contact {
namespace {

using std::numbers::inv_pi;

/// a(h) and its slope.
struct Seen {
  double value;
  double slope;
};

/// Beyond it what is left in closed form after its powers of h cancel loses digits; this many terms
/// of the series in 1 / h^2 have them all.
constexpr double kFar = 4.0;
constexpr std::size_t kTerms = 12;

/// a = 1/2 - sum of (-1)^j 8 / (pi (2j + 1) (2j + 3) (2j + 5)) h^-(2j + 1): by the moments
/// of 4 g (1 - g^2), which is how much levels t = T g weigh.
Seen seen_from_afar(double h) noexcept {
  static constexpr auto kCoefficients = [] {
    std::array<double, kTerms> of{};
    for (std::size_t j = 0; j < kTerms; ++j) {
      const double odd = 2.0 * static_cast<double>(j) + 1.0;
      of[j] = (j % 2 == 0 ? 8.0 : -8.0) * inv_pi / (odd * (odd + 2.0) * (odd + 4.0));
    }
    return of;
  }();
  const double inverse = 1.0 / h;
  const double square = inverse * inverse;
  double value = 0.0, slope = 0.0;
  for (std::size_t j = kTerms; j-- > 0;) {
    value = value * square + kCoefficients[j];
    slope = slope * square + (2.0 * static_cast<double>(j) + 1.0) * kCoefficients[j];
  }
  return {0.5 - value * inverse, slope * square};
}

/// @param h  foot over width
Seen seen(double h) noexcept {
  const double size = std::abs(h);
  Seen of;
  if (size > kFar) {
    of = seen_from_afar(size);
  } else {
    const double angle = elementary::atan(size);
    const double rest = 0.5 * std::numbers::pi - angle;
    const double square = size * size;
    of.value = inv_pi * (angle + size * (5.0 / 3.0 + square) - square * (2.0 + square) * rest);
    of.slope = 4.0 * inv_pi * (2.0 / 3.0 + square - size * (1.0 + square) * rest);
  }
  return {std::copysign(of.value, h), of.slope};
}

/// What arms of a node add up to.
struct Sums {
  Eigen::Matrix3d coupling = kTurn * Eigen::Matrix3d::Identity();
  Vec3 along = Vec3::Zero();
  Vec3 seen_along = Vec3::Zero();
  double seen = 0.0;
  double squared_length = 0.0;  ///< m^2
};

Sums look_along(const Vec3& separation, double distance, double width, std::span<WrapArm> arms) {
  Sums sums;
  for (WrapArm& arm : arms) {
    arm.length = arm.bar.norm();
    arm.direction = arm.length > 0.0 ? Vec3(arm.bar / arm.length) : Vec3(Vec3::Zero());
    arm.foot = -separation.dot(arm.direction);
    arm.along = arm.direction + arm.foot / (distance * distance) * separation;
    const Seen of = seen(arm.foot / width);
    arm.seen = of.value;
    arm.slope = of.slope / width;
    sums.coupling += arm.along * arm.along.transpose();
    sums.along += arm.along;
    sums.seen_along += arm.seen * arm.along;
    sums.seen += arm.seen;
    sums.squared_length += arm.length * arm.length;
  }
  return sums;
}

/// (1 + c^2) x^3 / (x^2 + c^2 X^2) and its derivatives.
struct Returned {
  double contacts;
  double by_turn;            ///< by x
  double by_squared_width;   ///< 1/m^2, by T^2 as far as X depends on it
  double by_squared_length;  ///< 1/m^2, by L^2
};

Returned returned(double turn, double count, double squared_length, double squared_width) {
  constexpr double kOfWidth = 9.0 * std::numbers::pi * std::numbers::pi / 64.0;
  const double most = 0.25 * kTurn * kTurn * count * count;  // of c^2 X^2
  const double sum = squared_length + kOfWidth * squared_width;
  const double bend = most * squared_length / sum;
  const double square = turn * turn;
  const double below = square + bend;
  const double factor = (1.0 + kTurn * kTurn) * square / below;
  const double by_bend = -factor * turn / below * most * kOfWidth / (sum * sum);
  return {factor * turn, factor * (square + 3.0 * bend) / below, -by_bend * squared_length,
          by_bend * squared_width};
}

}  // namespace

WrapShare wrap_share(const Vec3& separation, double range, std::span<WrapArm> arms) {
  for (WrapArm& arm : arms) arm.by_bar.setZero();
  const double distance = separation.norm();
  if (!(distance > 0.0 && distance < range) || arms.size() < 2) return {};
  const double squared_width = 2.0 * distance * (range - distance);
  const double width = std::sqrt(squared_width);
  const Sums sums = look_along(separation, distance, width, arms);
  // The weights are 1 - p . balance.
  const Eigen::Matrix3d inverse = sums.coupling.inverse();
  const Vec3 balance = inverse * sums.along;
  const Vec3 seen_balance = inverse * sums.seen_along;
  const double turn = sums.seen - sums.along.dot(seen_balance);
  const auto count = static_cast<double>(arms.size());
  // What rounding leaves of bars in line is no turn.
  if (!(turn > 4.0 * count * std::numeric_limits<double>::epsilon())) return {};

  const Returned of = returned(turn, count, sums.squared_length / count, squared_width);
  WrapShare share{of.contacts, Vec3::Zero()};
  double by_squared_width = of.by_squared_width;
  for (WrapArm& arm : arms) {
    const double weight = 1.0 - arm.along.dot(balance);
    const double by_foot = of.by_turn * weight * arm.slope;
    // Along the surface, as balance is.
    const Vec3 by_along =
        -of.by_turn * (weight * seen_balance + (arm.seen - arm.along.dot(seen_balance)) * balance);
    by_squared_width -= 0.5 * by_foot * arm.foot / squared_width;
    share.by_separation += arm.foot / (distance * distance) * by_along - by_foot * arm.direction;
    if (!(arm.length > 0.0)) continue;
    const Vec3 by_direction = by_along - by_foot * separation;
    arm.by_bar = (by_direction - by_direction.dot(arm.direction) * arm.direction) / arm.length +
                 2.0 * of.by_squared_length / count * arm.bar;
  }
  share.by_separation += by_squared_width * 2.0 * (range / distance - 2.0) * separation;
  return share;
}

}  // namespace plekton::contact
