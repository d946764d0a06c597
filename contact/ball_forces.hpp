// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/motion.hpp"
#include "contact/rekey.hpp"
#include "geometry/broad_phase.hpp"
#include "geometry/lanes.hpp"
#include "geometry/parallel_sum.hpp"
#include "geometry/vector_width.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

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

/// Forces of the pairs of a list, written down chunk by chunk of the list on any threads, and
/// summed ball by ball in the order of the pairs: the same bits for any number of threads.
class BallForces {
 public:
  /// Pairs in a chunk, the unit in which the list is shared by threads.
  static constexpr std::size_t kChunk = geometry::ParallelSum<double>::kChunk;

  /// Forces of the touching pairs of a chunk, to be written down in the order of the pairs.
  class Chunk {
   public:
    /// The place of the next force; it counts if its pair touches, otherwise the place is used
    /// again.
    /// @param pair  within the chunk
    PLEKTON_INLINE BallForce& next(std::size_t pair, bool touches) noexcept {
      pairs_[count_] = static_cast<std::uint16_t>(pair);
      BallForce& force = forces_[count_];
      count_ += touches;
      return force;
    }

   private:
    friend class BallForces;
    Chunk(BallForce* forces, std::uint16_t* pairs) : forces_(forces), pairs_(pairs) {}
    BallForce* forces_;
    std::uint16_t* pairs_;
    std::size_t count_ = 0;
  };

  /// Makes room for the forces of a new list of pairs, sorted, a < b.
  void assign(std::span<const geometry::IndexPair> pairs, std::size_t ball_count);

  std::size_t chunk_count() const noexcept { return counts_.size(); }
  Chunk chunk(std::size_t c) noexcept { return {&forces_[c * kChunk], &pairs_[c * kChunk]}; }
  void finish(std::size_t c, const Chunk& chunk) noexcept {
    counts_[c] = static_cast<std::uint32_t>(chunk.count_);
  }

  void set_sums_zero() {
    std::fill(sums_.begin(), sums_.end(), BallSum{Vec3::Zero(), Vec3::Zero(), {}});
  }

  /// Adds the forces of a chunk to the sums of its balls.
  PLEKTON_INLINE void add_chunk(std::size_t c, std::span<const geometry::IndexPair> pairs) {
    for_each_in_chunk(
        c, [&](std::size_t i, const BallForce& force) __attribute__((always_inline)) {
          add_to_a(sum_of(pairs[i].a), force);
          add_to_b(sum_of(pairs[i].b), force);
        });
  }

  /// Adds all forces to the sums of their balls, each thread for the balls that it owns.
  void add_all(std::span<const geometry::IndexPair> pairs, geometry::ThreadPool& pool);

  std::span<const BallSum> sums() const noexcept { return sums_; }

  /// Number of forces.
  std::size_t size() const noexcept {
    std::size_t size = 0;
    for (const std::uint32_t count : counts_) size += count;
    return size;
  }

  /// Calls visit(pair in the list, force) for every force, in order.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (std::size_t c = 0; c < counts_.size(); ++c) for_each_in_chunk(c, visit);
  }

 private:
  /// Balls from begin to before end.
  struct BallRange {
    std::size_t begin, end;

    bool holds(std::int32_t ball) const noexcept {
      return static_cast<std::size_t>(ball) >= begin && static_cast<std::size_t>(ball) < end;
    }
    bool holds(const BallRange& other) const noexcept {
      return other.begin >= begin && other.end <= end;
    }
    bool meets(const BallRange& other) const noexcept {
      return other.begin < end && begin < other.end;
    }
  };

  BallSum& sum_of(std::int32_t ball) noexcept { return sums_[static_cast<std::size_t>(ball)]; }

  /// Adds the forces of a chunk to the sums of some of its balls.
  PLEKTON_INLINE void add_part(std::size_t c, std::span<const geometry::IndexPair> pairs,
                               const BallRange& owned);

  template <class Visit>
  PLEKTON_INLINE void for_each_in_chunk(std::size_t c, Visit&& visit) const {
    const std::size_t begin = c * kChunk;
    const std::size_t end = begin + counts_[c];
    for (std::size_t k = begin; k < end; ++k) visit(begin + pairs_[k], forces_[k]);
  }

  std::vector<BallForce> forces_;      ///< the first counts_[c] of each chunk c
  std::vector<std::uint16_t> pairs_;   ///< of which pair of the chunk
  std::vector<std::uint32_t> counts_;  ///< by chunk
  std::vector<BallRange> balls_;       ///< by chunk: where its balls are
  std::vector<BallSum> sums_;          ///< by ball
};

inline void BallForces::assign(std::span<const geometry::IndexPair> pairs, std::size_t ball_count) {
  const std::size_t chunk_count = (pairs.size() + kChunk - 1) / kChunk;
  make_room(counts_, chunk_count);
  make_room(forces_, chunk_count * kChunk);
  make_room(pairs_, chunk_count * kChunk);
  make_room(balls_, chunk_count);
  counts_.assign(chunk_count, 0);
  forces_.resize(chunk_count * kChunk);
  pairs_.resize(chunk_count * kChunk);
  balls_.clear();
  for (std::size_t c = 0; c < chunk_count; ++c) {
    BallRange balls{static_cast<std::size_t>(pairs[c * kChunk].a), 0};
    for (const geometry::IndexPair& pair :
         pairs.subspan(c * kChunk, std::min(kChunk, pairs.size() - c * kChunk)))
      balls.end = std::max(balls.end, static_cast<std::size_t>(pair.b) + 1);
    balls_.push_back(balls);
  }
  sums_.resize(ball_count);
}

PLEKTON_INLINE void BallForces::add_part(std::size_t c, std::span<const geometry::IndexPair> pairs,
                                         const BallRange& owned) {
  for_each_in_chunk(
      c, [&](std::size_t i, const BallForce& force) __attribute__((always_inline)) {
        if (owned.holds(pairs[i].a)) add_to_a(sum_of(pairs[i].a), force);
        if (owned.holds(pairs[i].b)) add_to_b(sum_of(pairs[i].b), force);
      });
}

inline void BallForces::add_all(std::span<const geometry::IndexPair> pairs,
                                geometry::ThreadPool& pool) {
  pool.for_each_range(sums_.size(), [&](std::size_t begin, std::size_t end, int) {
    const BallRange owned{begin, end};
    std::fill(sums_.data() + begin, sums_.data() + end, BallSum{Vec3::Zero(), Vec3::Zero(), {}});
    geometry::with_widest_vectors([&](auto) __attribute__((always_inline)) {
      for (std::size_t c = 0; c < counts_.size(); ++c) {
        if (owned.holds(balls_[c])) {
          add_chunk(c, pairs);
        } else if (owned.meets(balls_[c])) {
          add_part(c, pairs, owned);
        }
      }
    });
  });
}

}  // namespace plekton::contact
