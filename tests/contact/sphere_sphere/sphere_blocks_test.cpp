// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/sphere_blocks.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace plekton::contact::sphere_blocks_test {
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
  std::vector<SphereBody> balls;
  std::vector<IndexPair> pairs;
};

struct Given {
  std::int32_t balls;
  int kinds;
};

class SphereBlocksOf : public testing::TestWithParam<Given> {
 protected:
  SphereBlocksOf() : crowd_(GetParam().balls) {
    if (GetParam().kinds > 1) {
      for (std::size_t i = 0; i < crowd_.pairs.size(); ++i)
        kinds_.push_back(static_cast<std::uint8_t>(i * i % 7 % std::size_t(GetParam().kinds)));
    }
    blocks_.assign(crowd_.pairs, crowd_.balls, kinds_, pool_, crowd_.x);
  }

  /// Calls visit(pair of the list, its row) for the pairs in a range.
  template <class Visit>
  void for_each_pair(const SphereBlocks::Range& range, const Visit& visit) const {
    for (std::size_t i = 0; i < crowd_.pairs.size(); ++i) {
      const std::size_t row = blocks_.slot(i) / SphereBlocks::kLanes;
      if (row >= range.first_row && row < range.first_row + range.row_count) visit(i, row);
    }
  }

  Crowd crowd_;
  std::vector<std::uint8_t> kinds_;
  geometry::ThreadPool pool_{2};
  SphereBlocks blocks_;
};

INSTANTIATE_TEST_SUITE_P(Crowds, SphereBlocksOf,
                         testing::Values(Given{3, 1}, Given{100, 1}, Given{1279, 1}, Given{1280, 1},
                                         Given{6000, 1}, Given{3, 3}, Given{1280, 3}),
                         [](const auto& given) {
                           return std::to_string(given.param.balls) + "_of_" +
                                  std::to_string(given.param.kinds);
                         });

TEST_P(SphereBlocksOf, HoldEveryPairOnce) {
  std::set<std::uint32_t> slots;
  for (const SphereBlocks::Block& block : blocks_.blocks()) {
    const auto members = blocks_.members(block);
    for (const SphereBlocks::Range& range : blocks_.ranges(block)) {
      for_each_pair(range, [&](std::size_t i, std::size_t row) {
        const std::uint32_t slot = blocks_.slot(i);
        EXPECT_TRUE(slots.insert(slot).second);
        const SphereBlocks::Pair& pair = blocks_.row(row)[slot % SphereBlocks::kLanes];
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

TEST_P(SphereBlocksOf, HavePairsOfAKindThatTouchInRowsOfTheirOwn) {
  std::size_t rows = 0;
  for (const SphereBlocks::Range& range : blocks_.ranges()) {
    EXPECT_EQ(range.first_row, rows);
    rows += range.row_count;
    for_each_pair(range, [&](std::size_t i, std::size_t) {
      const auto& [a, b] = crowd_.pairs[i];
      const double radii = crowd_.balls[static_cast<std::size_t>(a)].radius +
                           crowd_.balls[static_cast<std::size_t>(b)].radius;
      EXPECT_EQ(range.was_apart, !((crowd_.at(a) - crowd_.at(b)).norm() < radii));
      EXPECT_EQ(range.kind, kinds_.empty() ? 0 : kinds_[i]);
    });
  }
  EXPECT_EQ(rows, blocks_.row_count());
}

TEST_P(SphereBlocksOf, FillLanesWithoutAPairWithTheSphereOfNoSize) {
  for (const SphereBlocks::Block& block : blocks_.blocks()) {
    for (const SphereBlocks::Range& range : blocks_.ranges(block)) {
      std::size_t real = 0;
      for (std::size_t slot = 0; slot < range.slot_count(); ++slot) {
        const SphereBlocks::Pair& pair =
            blocks_.row(range.first_row + slot / SphereBlocks::kLanes)[slot % SphereBlocks::kLanes];
        if (pair.a == block.member_count - 1) {
          EXPECT_EQ(pair.b, pair.a);
          EXPECT_EQ(blocks_.members(block)[pair.a].radius, 0.0);
        } else {
          ++real;
        }
      }
      EXPECT_EQ(real, range.pair_count);
      EXPECT_GT(real + SphereBlocks::kLanes, range.slot_count());
    }
  }
}

TEST_P(SphereBlocksOf, OwnEverySphereOnceAndLendItToWhoBorrowsIt) {
  std::set<NodeId> owned;
  for (const SphereBlocks::Block& block : blocks_.blocks()) {
    for (const SphereBlocks::Member& ball : blocks_.owned(block))
      EXPECT_TRUE(owned.insert(ball.node).second);
  }
  EXPECT_EQ(owned.size(), blocks_.sphere_count());
  std::vector<NodeId> ghost;
  for (const SphereBlocks::Block& block : blocks_.blocks()) {
    EXPECT_EQ(ghost.size(), block.first_ghost);
    for (std::uint32_t m = block.owned; m + 1 < block.member_count; ++m)
      ghost.push_back(blocks_.members(block)[m].node);
  }
  EXPECT_EQ(ghost.size(), blocks_.ghost_count());
  std::vector<int> returned(ghost.size(), 0);
  for (std::size_t k = 0; k < blocks_.blocks().size(); ++k) {
    const auto own = blocks_.owned(blocks_.blocks()[k]);
    const auto add = [&](NodeId node, std::size_t which) {
      EXPECT_EQ(node, ghost[which]);
      EXPECT_TRUE(std::ranges::any_of(own, [&](const auto& ball) { return ball.node == node; }));
      ++returned[which];
    };
    blocks_.for_each_ghost(k, add,
                           [&](NodeId node, std::size_t which) { EXPECT_EQ(node, ghost[which]); });
  }
  EXPECT_EQ(std::ranges::count(returned, 1), static_cast<std::ptrdiff_t>(returned.size()));
}

TEST_P(SphereBlocksOf, NameTheNodesThatNoneOwns) {
  std::vector<int> named(crowd_.x.size(), 0);
  for (const SphereBlocks::Block& block : blocks_.blocks())
    for (const SphereBlocks::Member& ball : blocks_.owned(block)) ++named[index_of(ball.node)];
  for (const SphereBlocks::NodeRange& range : blocks_.other_nodes())
    for (std::size_t node = range.begin; node < range.end; ++node) ++named[node];
  EXPECT_EQ(named, std::vector<int>(crowd_.x.size(), 1));
}

TEST(SphereBlocks, BorrowFewBallsWhereNeighboursAreNearInSpace) {
  const Crowd crowd(6000);
  geometry::ThreadPool pool;
  SphereBlocks blocks;

  blocks.assign(crowd.pairs, crowd.balls, {}, pool, crowd.x);

  ASSERT_EQ(blocks.blocks().size(), 16u);
  // A cube of n balls has 6 n^(2/3) at its faces; half of what is beyond them is ghost, and the
  // layer is as thick as 1.4 distances of balls. Balls in no order would be ghost 4 times each.
  EXPECT_LT(blocks.member_count(), 6000 * 2);
}

TEST(SphereBlocks, TakeANewListInTheirOldOrder) {
  const Crowd crowd(3000);
  geometry::ThreadPool pool;
  SphereBlocks blocks;
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

TEST(SphereBlocks, OfNoPairsHaveNoRows) {
  const Crowd crowd(10);
  geometry::ThreadPool pool;
  SphereBlocks blocks;

  blocks.assign({}, crowd.balls, {}, pool, crowd.x);

  EXPECT_EQ(blocks.row_count(), 0u);
  EXPECT_EQ(blocks.sphere_count(), 0u);
}

}  // namespace
}  // namespace plekton::contact::sphere_blocks_test
