// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "geometry/base/lanes.hpp"

#include <array>

/// Forces of pairs of spheres and their sums: lines of the cache, added by whole vectors of
/// whatever width there is. Places of numbers in a line: force 0, torque or what it is made of 3.
namespace plekton::contact {

/// Force between two spheres that touch.
struct alignas(64) SphereForce {
  static constexpr std::size_t kArmA = 6, kArmB = 7;

  SphereForce() = default;
  /// @param force  N, on b
  /// @param force_cross_normal  N; times an arm it is the torque on that sphere
  /// @param arm_a, arm_b  m
  SphereForce(const Vec3& force, const Vec3& force_cross_normal, double arm_a,
              double arm_b) noexcept
      : numbers{force.x(),
                force.y(),
                force.z(),
                force_cross_normal.x(),
                force_cross_normal.y(),
                force_cross_normal.z(),
                arm_a,
                arm_b} {}

  std::array<double, 8> numbers;
};

/// Moment between two spheres that touch.
struct alignas(64) SphereMoment {
  SphereMoment() = default;
  /// @param moment  N m, on b
  explicit SphereMoment(const Vec3& moment) noexcept
      : numbers{0.0, 0.0, 0.0, moment.x(), moment.y(), moment.z(), 0.0, 0.0} {}

  std::array<double, 8> numbers;  ///< the last two: any
};

/// Sum of forces on a sphere.
struct alignas(64) SphereSum {
  Vec3 force() const noexcept { return {numbers[0], numbers[1], numbers[2]}; }   ///< N
  Vec3 torque() const noexcept { return {numbers[3], numbers[4], numbers[5]}; }  ///< N m

  std::array<double, 8> numbers{};  ///< the last two: any
};
static_assert(sizeof(SphereForce) == 64 && sizeof(SphereSum) == 64 && sizeof(SphereMoment) == 64);

namespace detail {

/// sum += (sign * force, arm * cross), W numbers at a time.
template <int W>
PLEKTON_INLINE void add_force(SphereSum& sum, const SphereForce& force, double sign,
                              double arm) noexcept {
  using Part = geometry::Pack<W>;
  geometry::detail::each<(6 + W - 1) / W>([&](auto part) __attribute__((always_inline)) {
    constexpr int kFirst = part * W;
    constexpr auto kFactor = [](int lane) { return kFirst + lane < 3 ? lane : W + lane; };
    const Part factor = geometry::pick<kFactor>(Part(sign), Part(arm));
    double* const to = sum.numbers.data() + kFirst;
    (Part::load(to) + factor * Part::load(force.numbers.data() + kFirst)).store(to);
    return 0;
  });
}

/// sum += sign * moment.
template <int W>
PLEKTON_INLINE void add_moment(SphereSum& sum, const SphereMoment& moment, double sign) noexcept {
  using Part = geometry::Pack<W>;
  geometry::detail::each<(6 + W - 1) / W>([&](auto part) __attribute__((always_inline)) {
    double* const to = sum.numbers.data() + part * W;
    (Part::load(to) + Part(sign) * Part::load(moment.numbers.data() + part * W)).store(to);
    return 0;
  });
}

}  // namespace detail

/// What a pair does to its spheres, by vectors of W numbers.
template <int W>
PLEKTON_INLINE void add_to_a(SphereSum& a, const SphereForce& force) noexcept {
  detail::add_force<W>(a, force, -1.0, force.numbers[SphereForce::kArmA]);
}
template <int W>
PLEKTON_INLINE void add_to_b(SphereSum& b, const SphereForce& force) noexcept {
  detail::add_force<W>(b, force, 1.0, force.numbers[SphereForce::kArmB]);
}

/// The same, then the moment.
template <int W>
PLEKTON_INLINE void add_to_a(SphereSum& a, const SphereForce& force,
                             const SphereMoment& moment) noexcept {
  add_to_a<W>(a, force);
  detail::add_moment<W>(a, moment, -1.0);
}
template <int W>
PLEKTON_INLINE void add_to_b(SphereSum& b, const SphereForce& force,
                             const SphereMoment& moment) noexcept {
  add_to_b<W>(b, force);
  detail::add_moment<W>(b, moment, 1.0);
}

}  // namespace plekton::contact
