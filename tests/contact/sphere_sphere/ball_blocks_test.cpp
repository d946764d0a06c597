// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/ball_blocks.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace plekton::contact {
namespace {

using geometry::IndexPair;

/// Balls at random places, each paired with all that are near. Their nodes are counted backwards.
struct Crowd {
  explicit Crowd(std::int32_t count) {
    test::Random random(5);
    for (std::int32_t i = 0; i < count; ++i) x.push_back(random.in_cube(1.0));
    for (std::int32_t i = 0; i < count; ++i)
      balls.push_back({NodeId{count - 1 - i}, random.uniform(0.1, 0.2), MaterialId{0}});
    const double near = 2.0 * std::cbrt(1.5 / count);
    for (std::int32_t a = 0; a < count; ++a) {
      for (std::int32_t b = a + 1; b < count; ++b)
        if ((at(a) - at(b)).norm() < near) pairs.push_back({a, b});
    }
  }
  const Vec3& at(std::int32_t ball) const {
    return x[index_of(balls[static_cast<std::size_t>(ball)].node)];
  }

  std::vector<Vec3> x;
  std::vector<Ball> balls;
  std::vector<IndexPair> pairs;
};

class BallBlocksOf : public testing::TestWithParam<std::int32_t> {
 protected:
  BallBlocksOf() : crowd_(GetParam()) {
    blocks_.assign(crowd_.pairs, crowd_.balls, pool_, crowd_.x);
  }

  Crowd crowd_;
  geometry::ThreadPool pool_{2};
  BallBlocks blocks_;
};

INSTANTIATE_TEST_SUITE_P(Crowds, BallBlocksOf, testing::Values(3, 100, 1279, 1280, 6000),
                         testing::PrintToStringParamName());

TEST_P(BallBlocksOf, HoldEveryPairOnce) {
  std::set<std::uint32_t> slots;
  for (const BallBlocks::Block& block : blocks_.blocks()) {
    const auto members = blocks_.members(block);
    for (std::size_t i = 0; i < crowd_.pairs.size(); ++i) {
      const std::uint32_t slot = blocks_.slot(i);
      const std::size_t row = slot / BallBlocks::kLanes;
      if (row < block.first_row || row >= block.first_row + block.row_count) continue;
      EXPECT_TRUE(slots.insert(slot).second);
      const BallBlocks::Pair& pair = blocks_.row(row)[slot % BallBlocks::kLanes];
      const auto& a = crowd_.balls[static_cast<std::size_t>(crowd_.pairs[i].a)];
      const auto& b = crowd_.balls[static_cast<std::size_t>(crowd_.pairs[i].b)];
      EXPECT_EQ(members[pair.a].node, a.node);
      EXPECT_EQ(members[pair.b].node, b.node);
      EXPECT_EQ(members[pair.a].radius, a.radius);
    }
  }
  EXPECT_EQ(slots.size(), crowd_.pairs.size());
}

TEST_P(BallBlocksOf, HavePairsThatTouchInRowsOfTheirOwn) {
  for (const BallBlocks::Block& block : blocks_.blocks()) {
    ASSERT_EQ(block.stretches[0].first_row, block.first_row);
    const std::size_t first_apart = block.stretches[1].first_row;
    EXPECT_EQ(first_apart, block.first_row + block.stretches[0].row_count);
    for (std::size_t i = 0; i < crowd_.pairs.size(); ++i) {
      const std::size_t row = blocks_.slot(i) / BallBlocks::kLanes;
      if (row < block.first_row || row >= block.first_row + block.row_count) continue;
      const auto& [a, b] = crowd_.pairs[i];
      const double radii = crowd_.balls[static_cast<std::size_t>(a)].radius +
                           crowd_.balls[static_cast<std::size_t>(b)].radius;
      EXPECT_EQ(row < first_apart, (crowd_.at(a) - crowd_.at(b)).norm() < radii);
    }
  }
}

TEST_P(BallBlocksOf, FillLanesWithoutAPairWithTheBallOfNoSize) {
  for (const BallBlocks::Block& block : blocks_.blocks()) {
    std::size_t real = 0;
    for (std::size_t row = block.first_row; row < block.first_row + block.row_count; ++row) {
      for (std::size_t lane = 0; lane < BallBlocks::kLanes; ++lane) {
        const BallBlocks::Pair& pair = blocks_.row(row)[lane];
        if (pair.a == block.member_count - 1) {
          EXPECT_EQ(pair.b, pair.a);
          EXPECT_EQ(blocks_.members(block)[pair.a].radius, 0.0);
        } else {
          ++real;
        }
      }
    }
    EXPECT_GT(real + 2 * BallBlocks::kLanes, block.row_count * BallBlocks::kLanes);
  }
}

TEST_P(BallBlocksOf, OwnEveryBallOnceAndLendItToWhoBorrowsIt) {
  std::set<NodeId> owned;
  for (const BallBlocks::Block& block : blocks_.blocks()) {
    for (const BallBlocks::Member& ball : blocks_.owned(block))
      EXPECT_TRUE(owned.insert(ball.node).second);
  }
  EXPECT_EQ(owned.size(), blocks_.ball_count());
  std::vector<NodeId> borrowed;
  for (const BallBlocks::Block& block : blocks_.blocks()) {
    EXPECT_EQ(borrowed.size(), block.first_borrowed);
    for (std::uint32_t m = block.owned; m + 1 < block.member_count; ++m)
      borrowed.push_back(blocks_.members(block)[m].node);
  }
  EXPECT_EQ(borrowed.size(), blocks_.borrowed_count());
  std::vector<int> returned(borrowed.size(), 0);
  for (std::size_t k = 0; k < blocks_.blocks().size(); ++k) {
    const auto own = blocks_.owned(blocks_.blocks()[k]);
    const auto add = [&](NodeId node, std::size_t which) {
      EXPECT_EQ(node, borrowed[which]);
      EXPECT_TRUE(std::ranges::any_of(own, [&](const auto& ball) { return ball.node == node; }));
      ++returned[which];
    };
    blocks_.for_each_loan(
        k, add, [&](NodeId node, std::size_t which) { EXPECT_EQ(node, borrowed[which]); });
  }
  EXPECT_EQ(std::ranges::count(returned, 1), static_cast<std::ptrdiff_t>(returned.size()));
}

TEST_P(BallBlocksOf, NameTheNodesThatNoneOwns) {
  std::vector<int> named(crowd_.x.size(), 0);
  for (const BallBlocks::Block& block : blocks_.blocks())
    for (const BallBlocks::Member& ball : blocks_.owned(block)) ++named[index_of(ball.node)];
  for (const BallBlocks::NodeRange& range : blocks_.other_nodes())
    for (std::size_t node = range.begin; node < range.end; ++node) ++named[node];
  EXPECT_EQ(named, std::vector<int>(crowd_.x.size(), 1));
}

TEST(BallBlocks, BorrowFewBallsWhereNeighboursAreNearInSpace) {
  const Crowd crowd(6000);
  geometry::ThreadPool pool;
  BallBlocks blocks;

  blocks.assign(crowd.pairs, crowd.balls, pool, crowd.x);

  ASSERT_EQ(blocks.blocks().size(), 16u);
  // A cube of n balls has 6 n^(2/3) at its faces; half of what is beyond them is borrowed, and the
  // layer is as thick as 1.4 distances of balls. Balls in no order would be borrowed 4 times each.
  EXPECT_LT(blocks.member_count(), 6000 * 2);
}

TEST(BallBlocks, TakeANewListInTheirOldOrder) {
  const Crowd crowd(3000);
  geometry::ThreadPool pool;
  BallBlocks blocks;
  blocks.assign(crowd.pairs, crowd.balls, pool, crowd.x);
  std::vector<IndexPair> fewer;
  for (std::size_t i = 0; i < crowd.pairs.size(); i += 2) fewer.push_back(crowd.pairs[i]);

  for (int list = 0; list < 20; ++list) {
    blocks.assign(list % 2 == 0 ? fewer : crowd.pairs, crowd.balls, pool, crowd.x);
    const auto& pairs = list % 2 == 0 ? fewer : crowd.pairs;
    std::set<std::uint32_t> slots;
    for (std::size_t i = 0; i < pairs.size(); ++i) slots.insert(blocks.slot(i));
    EXPECT_EQ(slots.size(), pairs.size());
  }
}

TEST(BallBlocks, OfNoPairsHaveNoRows) {
  const Crowd crowd(10);
  geometry::ThreadPool pool;
  BallBlocks blocks;

  blocks.assign({}, crowd.balls, pool, crowd.x);

  EXPECT_EQ(blocks.row_count(), 0u);
  EXPECT_EQ(blocks.ball_count(), 0u);
}

}  // namespace
}  // namespace plekton::contact
