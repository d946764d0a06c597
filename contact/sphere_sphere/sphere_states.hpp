// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/sphere_sphere/sphere_blocks.hpp"
#include "contact/sphere_sphere/sphere_kernel.hpp"
#include "contact/tracking/rekey.hpp"
#include "geometry/base/lanes.hpp"

#include <array>
#include <span>
#include <vector>

namespace plekton::contact {

/// Copies of what contacts read of the spheres of a block, one or two lines of the cache for each
/// sphere, so that pairs are gathered by whole vectors.
class SphereStates {
 public:
  /// For blocks of up to a number of members. Allocates only for more than ever before.
  void reserve(std::size_t member_count) {
    make_room(moves_, member_count);
    make_room(spins_, member_count);
    moves_.resize(member_count);
    spins_.resize(member_count);
  }

  /// Copies the motion of the members' nodes; the last member is the sphere of no size.
  void load(std::span<const SphereBlocks::Member> members, const Motion& motion) noexcept {
    const std::size_t spheres = members.size() - 1;
    for (std::size_t m = 0; m < spheres; ++m) {
      // Nodes may lie anywhere: far ahead, so that none is waited for.
      const std::size_t ahead = index_of(members[std::min(m + kAhead, spheres - 1)].node);
      __builtin_prefetch(&motion.position[ahead]);
      __builtin_prefetch(&motion.velocity[ahead]);
      __builtin_prefetch(&motion.angular_velocity[ahead]);
      const std::size_t node = index_of(members[m].node);
      moves_[m] = {motion.position[node], motion.velocity[node], {}};
      spins_[m] = {motion.angular_velocity[node], members[m].radius};
    }
    moves_[spheres] = {Vec3::Zero(), Vec3::Zero(), {}};
    spins_[spheres] = {Vec3::Zero(), 0.0};
  }

  SphereMotionOf<double> pair(const SphereBlocks::Pair& pair) const noexcept {
    const Move& move_a = moves_[pair.a];
    const Move& move_b = moves_[pair.b];
    const Spin& spin_a = spins_[pair.a];
    const Spin& spin_b = spins_[pair.b];
    return {move_b.position - move_a.position,
            move_b.velocity - move_a.velocity,
            spin_a.spin,
            spin_b.spin,
            spin_a.radius,
            spin_b.radius};
  }

  /// Whether any pair of a row touches: as SphereMotionOf::touch() tells it.
  template <int W>
  PLEKTON_INLINE bool any_touch(const SphereBlocks::Pair* row) const noexcept {
    using Real = geometry::Pack<W>;
    for (std::size_t first = 0; first < SphereBlocks::kLanes; first += std::size_t{W}) {
      const SphereBlocks::Pair* const pairs = row + first;
      std::array<double, std::size_t{W}> ranges;
      for (std::size_t lane = 0; lane < std::size_t{W}; ++lane)
        ranges[lane] = spins_[pairs[lane].a].radius + spins_[pairs[lane].b].radius;
      const auto [x, y, z, unused] = geometry::gather_things<W, 4>([&](
          std::size_t lane, auto part) __attribute__((always_inline)) {
        using Part = typename decltype(part)::Pack;
        return Part::load(moves_[pairs[lane].b].position.data() + part.first) -
               Part::load(moves_[pairs[lane].a].position.data() + part.first);
      });
      const Real range = Real::load(ranges.data());
      const Vec3Of<Real> separation{x, y, z};
      if (bits_of(geometry::flag(range * range > separation.squaredNorm())) != 0) return true;
    }
    return false;
  }

  /// W pairs side by side. Differences are taken before the numbers change places.
  template <int W>
  PLEKTON_INLINE SphereMotionOf<geometry::Pack<W>> pairs(
      const SphereBlocks::Pair* pairs) const noexcept {
    const auto [x, y, z, u, v, w, unused, unused_too] = geometry::gather_things<W, 8>([&](
        std::size_t lane, auto part) __attribute__((always_inline)) {
      using Part = typename decltype(part)::Pack;
      return Part::load(moves_[pairs[lane].b].position.data() + part.first) -
             Part::load(moves_[pairs[lane].a].position.data() + part.first);
    });
    const auto [ax, ay, az, ra] = spins<W>([&](std::size_t lane) { return pairs[lane].a; });
    const auto [bx, by, bz, rb] = spins<W>([&](std::size_t lane) { return pairs[lane].b; });
    return {{x, y, z}, {u, v, w}, {ax, ay, az}, {bx, by, bz}, ra, rb};
  }

 private:
  static constexpr std::size_t kAhead = 16;

  struct alignas(64) Move {
    Vec3 position;  ///< m
    Vec3 velocity;  ///< m/s
    std::array<double, 2> unused;
  };
  struct alignas(32) Spin {
    Vec3 spin;      ///< rad/s
    double radius;  ///< m
  };
  static_assert(sizeof(Move) == 64 && sizeof(Spin) == 32);

  template <int W, class Member>
  PLEKTON_INLINE auto spins(const Member& member) const noexcept {
    return geometry::gather_things<W, 4>([&](std::size_t lane,
                                             auto part) __attribute__((always_inline)) {
      using Part = typename decltype(part)::Pack;
      return Part::load(spins_[member(lane)].spin.data() + part.first);
    });
  }

  std::vector<Move> moves_;
  std::vector<Spin> spins_;
};

}  // namespace plekton::contact
