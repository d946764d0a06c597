// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/ball_blocks.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
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

struct Given {
  std::int32_t balls;
  int kinds;
};

class BallBlocksOf : public testing::TestWithParam<Given> {
 protected:
  BallBlocksOf() : crowd_(GetParam().balls) {
    if (GetParam().kinds > 1) {
      for (std::size_t i = 0; i < crowd_.pairs.size(); ++i)
        kinds_.push_back(static_cast<std::uint8_t>(i * i % 7 % std::size_t(GetParam().kinds)));
    }
    blocks_.assign(crowd_.pairs, crowd_.balls, kinds_, pool_, crowd_.x);
  }

  /// Calls visit(pair of the list, its row) for the pairs in a stretch.
  template <class Visit>
  void for_each_pair(const BallBlocks::Stretch& stretch, const Visit& visit) const {
    for (std::size_t i = 0; i < crowd_.pairs.size(); ++i) {
      const std::size_t row = blocks_.slot(i) / BallBlocks::kLanes;
      if (row >= stretch.first_row && row < stretch.first_row + stretch.row_count) visit(i, row);
    }
  }

  Crowd crowd_;
  std::vector<std::uint8_t> kinds_;
  geometry::ThreadPool pool_{2};
  BallBlocks blocks_;
};

INSTANTIATE_TEST_SUITE_P(Crowds, BallBlocksOf,
                         testing::Values(Given{3, 1}, Given{100, 1}, Given{1279, 1}, Given{1280, 1},
                                         Given{6000, 1}, Given{3, 3}, Given{1280, 3}),
                         [](const auto& given) {
                           return std::to_string(given.param.balls) + "_of_" +
                                  std::to_string(given.param.kinds);
                         });

TEST_P(BallBlocksOf, HoldEveryPairOnce) {
  std::set<std::uint32_t> slots;
  for (const BallBlocks::Block& block : blocks_.blocks()) {
    const auto members = blocks_.members(block);
    for (const BallBlocks::Stretch& stretch : blocks_.stretches(block)) {
      for_each_pair(stretch, [&](std::size_t i, std::size_t row) {
        const std::uint32_t slot = blocks_.slot(i);
        EXPECT_TRUE(slots.insert(slot).second);
        const BallBlocks::Pair& pair = blocks_.row(row)[slot % BallBlocks::kLanes];
        const auto& a = crowd_.balls[static_cast<std::size_t>(crowd_.pairs[i].a)];
        const auto& b = crowd_.balls[static_cast<std::size_t>(crowd_.pairs[i].b)];
        EXPECT_EQ(members[pair.a].node, a.node);
        EXPECT_EQ(members[pair.b].node, b.node);
        EXPECT_EQ(members[pair.a].radius, a.radius);
      });
    }
  }
  EXPECT_EQ(slots.size(), crowd_.pairs.size());
}

TEST_P(BallBlocksOf, HavePairsOfAKindThatTouchInRowsOfTheirOwn) {
  std::size_t rows = 0;
  for (const BallBlocks::Stretch& stretch : blocks_.stretches()) {
    EXPECT_EQ(stretch.first_row, rows);
    rows += stretch.row_count;
    for_each_pair(stretch, [&](std::size_t i, std::size_t) {
      const auto& [a, b] = crowd_.pairs[i];
      const double radii = crowd_.balls[static_cast<std::size_t>(a)].radius +
                           crowd_.balls[static_cast<std::size_t>(b)].radius;
      EXPECT_EQ(stretch.was_apart, !((crowd_.at(a) - crowd_.at(b)).norm() < radii));
      EXPECT_EQ(stretch.kind, kinds_.empty() ? 0 : kinds_[i]);
    });
  }
  EXPECT_EQ(rows, blocks_.row_count());
}

TEST_P(BallBlocksOf, FillLanesWithoutAPairWithTheBallOfNoSize) {
  for (const BallBlocks::Block& block : blocks_.blocks()) {
    for (const BallBlocks::Stretch& stretch : blocks_.stretches(block)) {
      std::size_t real = 0;
      for (std::size_t slot = 0; slot < stretch.slot_count(); ++slot) {
        const BallBlocks::Pair& pair =
            blocks_.row(stretch.first_row + slot / BallBlocks::kLanes)[slot % BallBlocks::kLanes];
        if (pair.a == block.member_count - 1) {
          EXPECT_EQ(pair.b, pair.a);
          EXPECT_EQ(blocks_.members(block)[pair.a].radius, 0.0);
        } else {
          ++real;
        }
      }
      EXPECT_EQ(real, stretch.pair_count);
      EXPECT_GT(real + BallBlocks::kLanes, stretch.slot_count());
    }
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

  blocks.assign(crowd.pairs, crowd.balls, {}, pool, crowd.x);

  ASSERT_EQ(blocks.blocks().size(), 16u);
  // A cube of n balls has 6 n^(2/3) at its faces; half of what is beyond them is borrowed, and the
  // layer is as thick as 1.4 distances of balls. Balls in no order would be borrowed 4 times each.
  EXPECT_LT(blocks.member_count(), 6000 * 2);
}

TEST(BallBlocks, TakeANewListInTheirOldOrder) {
  const Crowd crowd(3000);
  geometry::ThreadPool pool;
  BallBlocks blocks;
  blocks.assign(crowd.pairs, crowd.balls, {}, pool, crowd.x);
  std::vector<IndexPair> fewer;
  for (std::size_t i = 0; i < crowd.pairs.size(); i += 2) fewer.push_back(crowd.pairs[i]);

  for (int list = 0; list < 20; ++list) {
    blocks.assign(list % 2 == 0 ? fewer : crowd.pairs, crowd.balls, {}, pool, crowd.x);
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

  blocks.assign({}, crowd.balls, {}, pool, crowd.x);

  EXPECT_EQ(blocks.row_count(), 0u);
  EXPECT_EQ(blocks.ball_count(), 0u);
}

}  // namespace
}  // namespace plekton::contact
