// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/motion.hpp"
#include "geometry/lanes.hpp"

#include <array>

namespace plekton::contact {

/// Force between two balls that touch.
struct alignas(64) BallForce {
  Vec3 force;               ///< N, on b
  Vec3 force_cross_normal;  ///< N; times an arm it is the torque on that ball
  double arm_a;             ///< m
  double arm_b;             ///< m
};

/// Sum of forces on a ball.
struct alignas(64) BallSum {
  Vec3 force;                    ///< N
  Vec3 torque;                   ///< N m
  std::array<double, 2> unused;  ///< any numbers
};
static_assert(sizeof(BallForce) == 64 && sizeof(BallSum) == 64);

/// Adds (-force, arm_a * cross), in whole vectors: a factor for each number of the row.
PLEKTON_INLINE void add_to_a(BallSum& a, const BallForce& force) noexcept {
  using Row = geometry::Pack<8>;
  constexpr auto kFactor = [](int n) { return n < 3 ? 8 : 6; };
  const Row row = Row::load(force.force.data());
  double* const sum = a.force.data();
  (Row::load(sum) + geometry::pick<kFactor>(row, Row(-1.0)) * row).store(sum);
}
/// Adds (force, arm_b * cross).
PLEKTON_INLINE void add_to_b(BallSum& b, const BallForce& force) noexcept {
  using Row = geometry::Pack<8>;
  constexpr auto kFactor = [](int n) { return n < 3 ? 8 : 7; };
  const Row row = Row::load(force.force.data());
  double* const sum = b.force.data();
  (Row::load(sum) + geometry::pick<kFactor>(row, Row(1.0)) * row).store(sum);
}

}  // namespace plekton::contact
