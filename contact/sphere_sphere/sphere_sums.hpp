// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "geometry/base/lanes.hpp"

#include <array>

/// Forces of pairs of spheres and their sums: lines of the cache, added by whole vectors of
/// whatever width there is. Places of numbers in a line: force 0, torque 3.
namespace plekton::contact {

/// What a pair does to one of its spheres.
struct alignas(64) SphereForce {
  SphereForce() = default;
  /// @param force   N
  /// @param torque  N m
  SphereForce(const Vec3& force, const Vec3& torque) noexcept
      : numbers{force.x(), force.y(), force.z(), torque.x(), torque.y(), torque.z(), 0.0, 0.0} {}

  std::array<double, 8> numbers;  ///< the last two: any
};

/// Sum of forces on a sphere.
struct alignas(64) SphereSum {
  Vec3 force() const noexcept { return {numbers[0], numbers[1], numbers[2]}; }   ///< N
  Vec3 torque() const noexcept { return {numbers[3], numbers[4], numbers[5]}; }  ///< N m

  std::array<double, 8> numbers{};  ///< the last two: any
};
static_assert(sizeof(SphereForce) == 64 && sizeof(SphereSum) == 64);

/// W numbers at a time.
template <int W>
PLEKTON_INLINE void add_to(SphereSum& sum, const SphereForce& force) noexcept {
  using Part = geometry::Pack<W>;
  geometry::detail::each<(6 + W - 1) / W>([&](auto part) __attribute__((always_inline)) {
    double* const to = sum.numbers.data() + part * W;
    (Part::load(to) + Part::load(force.numbers.data() + part * W)).store(to);
    return 0;
  });
}

}  // namespace plekton::contact
