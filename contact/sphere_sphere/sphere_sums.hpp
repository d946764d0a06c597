// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "geometry/base/lanes.hpp"

#include <array>

namespace plekton::contact {

/// Force between two spheres that touch.
struct alignas(64) SphereForce {
  Vec3 force;               ///< N, on b
  Vec3 force_cross_normal;  ///< N; times an arm it is the torque on that sphere
  double arm_a;             ///< m
  double arm_b;             ///< m
};

/// Moment between two spheres that touch, where a SphereSum has its torque.
struct alignas(64) SphereMoment {
  Vec3 none;                     ///< zero
  Vec3 moment;                   ///< N m, on b
  std::array<double, 2> unused;  ///< any numbers
};

/// Sum of forces on a sphere.
struct alignas(64) SphereSum {
  Vec3 force;                    ///< N
  Vec3 torque;                   ///< N m
  std::array<double, 2> unused;  ///< any numbers
};
static_assert(sizeof(SphereForce) == 64 && sizeof(SphereSum) == 64 && sizeof(SphereMoment) == 64);

/// Adds (-force, arm_a * cross), in whole vectors: a factor for each number of the row.
PLEKTON_INLINE void add_to_a(SphereSum& a, const SphereForce& force) noexcept {
  using Row = geometry::Pack<8>;
  constexpr auto kFactor = [](int n) { return n < 3 ? 8 : 6; };
  const Row row = Row::load(force.force.data());
  double* const sum = a.force.data();
  (Row::load(sum) + geometry::pick<kFactor>(row, Row(-1.0)) * row).store(sum);
}
/// Adds (force, arm_b * cross).
PLEKTON_INLINE void add_to_b(SphereSum& b, const SphereForce& force) noexcept {
  using Row = geometry::Pack<8>;
  constexpr auto kFactor = [](int n) { return n < 3 ? 8 : 7; };
  const Row row = Row::load(force.force.data());
  double* const sum = b.force.data();
  (Row::load(sum) + geometry::pick<kFactor>(row, Row(1.0)) * row).store(sum);
}

/// The same, then the moment.
PLEKTON_INLINE void add_to_a(SphereSum& a, const SphereForce& force,
                             const SphereMoment& moment) noexcept {
  using Row = geometry::Pack<8>;
  add_to_a(a, force);
  (Row::load(a.force.data()) - Row::load(moment.none.data())).store(a.force.data());
}
PLEKTON_INLINE void add_to_b(SphereSum& b, const SphereForce& force,
                             const SphereMoment& moment) noexcept {
  using Row = geometry::Pack<8>;
  add_to_b(b, force);
  (Row::load(b.force.data()) + Row::load(moment.none.data())).store(b.force.data());
}

}  // namespace plekton::contact
