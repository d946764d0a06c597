// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/balls/ball_blocks.hpp"
#include "contact/balls/ball_kernel.hpp"
#include "contact/rekey.hpp"
#include "geometry/lanes.hpp"

#include <span>
#include <vector>

namespace plekton::contact {

/// Copies of what contacts read of the balls of a block, one or two lines of the cache for each
/// ball, so that pairs are gathered by whole vectors.
class BallRows {
 public:
  /// For blocks of up to a number of members. Allocates only for more than ever before.
  void reserve(std::size_t member_count) {
    make_room(moves_, member_count);
    make_room(spins_, member_count);
    moves_.resize(member_count);
    spins_.resize(member_count);
  }

  /// Copies the motion of the members' nodes; the last member is the ball of no size.
  void load(std::span<const BallBlocks::Member> members, const Motion& motion) noexcept {
    const std::size_t balls = members.size() - 1;
    for (std::size_t m = 0; m < balls; ++m) {
      // Nodes may lie anywhere: far ahead, so that none is waited for.
      const std::size_t ahead = index_of(members[std::min(m + kAhead, balls - 1)].node);
      __builtin_prefetch(&motion.position[ahead]);
      __builtin_prefetch(&motion.velocity[ahead]);
      __builtin_prefetch(&motion.angular_velocity[ahead]);
      const std::size_t node = index_of(members[m].node);
      moves_[m] = {motion.position[node], members[m].radius, motion.velocity[node], 0.0};
      spins_[m] = {motion.angular_velocity[node], 0.0};
    }
    moves_[balls] = {Vec3::Zero(), 0.0, Vec3::Zero(), 0.0};
    spins_[balls] = {Vec3::Zero(), 0.0};
  }

  BallMotionOf<double> pair(const BallBlocks::Pair& pair) const noexcept {
    const Move& a = moves_[pair.a];
    const Move& b = moves_[pair.b];
    return {b.position - a.position,
            b.velocity - a.velocity,
            spins_[pair.a].spin,
            spins_[pair.b].spin,
            a.radius,
            b.radius};
  }

  /// W pairs side by side.
  template <int W>
  PLEKTON_INLINE BallMotionOf<geometry::Pack<W>> pairs(
      const BallBlocks::Pair* pairs) const noexcept {
    const auto a = [&](std::size_t lane) { return std::size_t{pairs[lane].a}; };
    const auto b = [&](std::size_t lane) { return std::size_t{pairs[lane].b}; };
    const auto [ax, ay, az, ra, au, av, aw, a_unused] = moves<W>(a);
    const auto [bx, by, bz, rb, bu, bv, bw, b_unused] = moves<W>(b);
    return {
        {bx - ax, by - ay, bz - az}, {bu - au, bv - av, bw - aw}, spins<W>(a), spins<W>(b), ra, rb};
  }

 private:
  static constexpr std::size_t kAhead = 16;

  struct alignas(64) Move {
    Vec3 position;  ///< m
    double radius;  ///< m
    Vec3 velocity;  ///< m/s
    double unused;
  };
  struct alignas(32) Spin {
    Vec3 spin;  ///< rad/s
    double unused;
  };
  static_assert(sizeof(Move) == 64 && sizeof(Spin) == 32);

  template <int W, class Ball>
  PLEKTON_INLINE auto moves(const Ball& ball) const noexcept {
    return geometry::gather_things<W, 8>([&](std::size_t lane) __attribute__((always_inline)) {
      return moves_[ball(lane)].position.data();
    });
  }
  template <int W, class Ball>
  PLEKTON_INLINE geometry::PackVec3<geometry::Pack<W>> spins(const Ball& ball) const noexcept {
    const auto [x, y, z, unused] =
        geometry::gather_things<W, 4>([&](std::size_t lane) __attribute__((always_inline)) {
          return spins_[ball(lane)].spin.data();
        });
    return {x, y, z};
  }

  std::vector<Move> moves_;
  std::vector<Spin> spins_;
};

}  // namespace plekton::contact
