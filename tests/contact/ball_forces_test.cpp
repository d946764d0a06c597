// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/ball_forces.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace plekton::contact {
namespace {

using geometry::IndexPair;

constexpr std::size_t kBalls = 200;

/// Pairs of near and of far balls, several chunks of them, of which some touch.
struct Crowd {
  Crowd() {
    test::Random random(3);
    for (std::int32_t a = 0; a < std::int32_t{kBalls}; ++a) {
      for (std::int32_t b = a + 1; b < std::int32_t{kBalls}; ++b)
        if (random.unit() < (b - a < 10 ? 0.5 : 0.02)) pairs.push_back({a, b});
    }
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      touches.push_back(random.unit() < 0.7);
      written.push_back({random.in_cube(1.0), random.in_cube(1.0), random.unit(), random.unit()});
    }
  }

  void write_down(BallForces& forces) const {
    for (std::size_t c = 0; c < forces.chunk_count(); ++c) {
      auto chunk = forces.chunk(c);
      for (std::size_t k = 0; k < BallForces::kChunk && c * BallForces::kChunk + k < pairs.size();
           ++k) {
        const std::size_t i = c * BallForces::kChunk + k;
        chunk.next(k, touches[i]) = written[i];
      }
      forces.finish(c, chunk);
    }
  }

  std::vector<IndexPair> pairs;
  std::vector<bool> touches;
  std::vector<BallForce> written;
};

/// One pair after the other.
NodeForces plain_sums(const Crowd& crowd) {
  NodeForces sums(kBalls);
  for (std::size_t i = 0; i < crowd.pairs.size(); ++i) {
    if (!crowd.touches[i]) continue;
    const auto a = static_cast<std::size_t>(crowd.pairs[i].a);
    const auto b = static_cast<std::size_t>(crowd.pairs[i].b);
    const BallForce& of_pair = crowd.written[i];
    sums.force[a] -= of_pair.force;
    sums.force[b] += of_pair.force;
    sums.torque[a] += of_pair.arm_a * of_pair.force_cross_normal;
    sums.torque[b] += of_pair.arm_b * of_pair.force_cross_normal;
  }
  return sums;
}

void expect_sums(const BallForces& forces, const NodeForces& expected) {
  for (std::size_t ball = 0; ball < kBalls; ++ball) {
    EXPECT_EQ(forces.sums()[ball].force, expected.force[ball]);
    EXPECT_EQ(forces.sums()[ball].torque, expected.torque[ball]);
  }
}

TEST(BallForces, AreVisitedInTheOrderOfTheirPairs) {
  const Crowd crowd;
  BallForces forces;
  forces.assign(crowd.pairs, kBalls);

  crowd.write_down(forces);

  std::vector<std::size_t> expected;
  for (std::size_t i = 0; i < crowd.pairs.size(); ++i)
    if (crowd.touches[i]) expected.push_back(i);
  std::vector<std::size_t> visited;
  forces.for_each([&](std::size_t i, const BallForce& force) {
    visited.push_back(i);
    EXPECT_EQ(force.force, crowd.written[i].force);
  });
  EXPECT_EQ(visited, expected);
  EXPECT_EQ(forces.size(), expected.size());
}

TEST(BallForces, AddUpToTheBitsOfOnePairAfterTheOtherForAnyNumberOfThreads) {
  const Crowd crowd;
  const NodeForces expected = plain_sums(crowd);
  for (const int threads : {1, 2, 3, 7}) {
    geometry::ThreadPool pool(threads);
    BallForces forces;
    forces.assign(crowd.pairs, kBalls);
    crowd.write_down(forces);

    forces.add_all(crowd.pairs, pool);
    expect_sums(forces, expected);
    forces.add_all(crowd.pairs, pool);  // not on top of the last sums
    expect_sums(forces, expected);
  }
}

TEST(BallForces, AddUpChunkByChunkToo) {
  const Crowd crowd;
  BallForces forces;
  forces.assign(crowd.pairs, kBalls);
  crowd.write_down(forces);

  forces.set_sums_zero();
  for (std::size_t c = 0; c < forces.chunk_count(); ++c) forces.add_chunk(c, crowd.pairs);

  expect_sums(forces, plain_sums(crowd));
}

TEST(BallForces, OfNoPairsAreNothing) {
  geometry::ThreadPool pool(2);
  BallForces forces;
  forces.assign({}, 0);

  forces.add_all({}, pool);

  EXPECT_EQ(forces.size(), 0U);
  EXPECT_TRUE(forces.sums().empty());
}

}  // namespace
}  // namespace plekton::contact
