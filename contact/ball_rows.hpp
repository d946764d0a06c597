// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/ball_kernel.hpp"
#include "contact/bodies.hpp"
#include "geometry/broad_phase.hpp"
#include "geometry/lanes.hpp"
#include "geometry/thread_pool.hpp"

#include <span>
#include <vector>

namespace plekton::contact {

/// Copies of what contacts read of balls, one or two lines of the cache for each ball, so that
/// pairs are gathered by whole vectors.
class BallRows {
 public:
  /// Takes balls; their copies hold no motion yet. Allocates only for more balls than ever before.
  void assign(std::span<const Ball> balls) {
    nodes_.clear();
    for (const Ball& ball : balls) nodes_.push_back(ball.node);
    // One more, of no size, for lanes without a pair: it never touches anything.
    moves_.assign(balls.size() + 1, Move{Vec3::Zero(), 0.0, Vec3::Zero(), 0.0});
    spins_.assign(balls.size() + 1, Spin{Vec3::Zero(), 0.0});
    for (std::size_t i = 0; i < balls.size(); ++i) moves_[i].radius = balls[i].radius;
  }

  /// Copies the motion of the balls' nodes.
  void update(const Motion& motion, geometry::ThreadPool& pool) {
    pool.for_each_range(nodes_.size(), [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t node = index_of(nodes_[i]);
        moves_[i].position = motion.position[node];
        moves_[i].velocity = motion.velocity[node];
        spins_[i].spin = motion.angular_velocity[node];
      }
    });
  }

  /// Without the ball of no size.
  std::size_t size() const noexcept { return nodes_.size(); }
  NodeId node(std::int32_t ball) const noexcept { return nodes_[static_cast<std::size_t>(ball)]; }
  /// The ball of no size.
  std::int32_t none() const noexcept { return static_cast<std::int32_t>(nodes_.size()); }

  BallMotionOf<double> pair(const geometry::IndexPair& pair) const noexcept {
    const auto a = static_cast<std::size_t>(pair.a);
    const auto b = static_cast<std::size_t>(pair.b);
    return {moves_[b].position - moves_[a].position,
            moves_[b].velocity - moves_[a].velocity,
            spins_[a].spin,
            spins_[b].spin,
            moves_[a].radius,
            moves_[b].radius};
  }

  /// W pairs side by side.
  template <int W>
  PLEKTON_INLINE BallMotionOf<geometry::Pack<W>> pairs(
      const geometry::IndexPair* pairs) const noexcept {
    const auto a = [&](std::size_t lane) { return static_cast<std::size_t>(pairs[lane].a); };
    const auto b = [&](std::size_t lane) { return static_cast<std::size_t>(pairs[lane].b); };
    const auto [ax, ay, az, ra, au, av, aw, a_unused] = moves<W>(a);
    const auto [bx, by, bz, rb, bu, bv, bw, b_unused] = moves<W>(b);
    return {
        {bx - ax, by - ay, bz - az}, {bu - au, bv - av, bw - aw}, spins<W>(a), spins<W>(b), ra, rb};
  }

 private:
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

  std::vector<NodeId> nodes_;
  std::vector<Move> moves_;
  std::vector<Spin> spins_;
};

}  // namespace plekton::contact
