// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neighbor/broad_phase.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace plekton::geometry {

static void PrintTo(const IndexPair& pair, std::ostream* stream) {
  *stream << "(" << pair.a << ", " << pair.b << ")";
}

namespace broad_phase_test {
namespace {

using Pairs = std::vector<IndexPair>;
using Boxes = std::vector<Box>;

bool closed_boxes_overlap(const Box& p, const Box& q) {
  return (p.lower.array() <= q.upper.array()).all() && (q.lower.array() <= p.upper.array()).all();
}

Pairs self_pairs_by_definition(const Boxes& boxes) {
  Pairs pairs;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes.size(); ++j) {
      if (closed_boxes_overlap(boxes[i], boxes[j])) {
        pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
      }
    }
  }
  return pairs;
}

Pairs pairs_between_by_definition(const Boxes& boxes, const Boxes& others) {
  Pairs pairs;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = 0; j < others.size(); ++j) {
      if (closed_boxes_overlap(boxes[i], others[j])) {
        pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
      }
    }
  }
  return pairs;
}

Pairs self_pairs(const BroadPhase& broad_phase) {
  Pairs pairs{{7, 8}};  // To be replaced.
  broad_phase.self_pairs(pairs);
  return pairs;
}

Pairs pairs_between(const BroadPhase& broad_phase, const BroadPhase& other) {
  Pairs pairs{{7, 8}};
  broad_phase.pairs_with(other, pairs);
  return pairs;
}

BroadPhase broad_phase_of(const Boxes& boxes) {
  BroadPhase broad_phase;
  broad_phase.rebuild(boxes);
  return broad_phase;
}

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Box general_box(Random& random) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = uniform(random, -1.0, 1.0);
    box.upper[axis] = box.lower[axis] + uniform(random, 0.0, 0.6);
  }
  return box;
}

/// On integers: touches, zero sizes and identical boxes come by themselves.
Box lattice_box(Random& random) {
  std::uniform_int_distribution<int> corner(-3, 3);
  std::uniform_int_distribution<int> size(0, 2);
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = corner(random);
    box.upper[axis] = box.lower[axis] + size(random);
  }
  return box;
}

/// Of any size between 1e-140 and 1e140.
Box box_of_any_size(Random& random) {
  const double size = std::pow(10.0, uniform(random, -140.0, 140.0));
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = size * uniform(random, -1.0, 1.0);
    box.upper[axis] = box.lower[axis] + size * uniform(random, 0.0, 1.0);
  }
  return box;
}

Box point_box(Random& random) {
  const Vec3 point(uniform(random, 0.0, 1.0), 0.0, 0.0);
  return {point, point};
}

/// One of several families, with 0 to 80 boxes, some of them copies of others.
Boxes random_scene(Random& random, std::size_t family) {
  constexpr Box (*kFamilies[])(Random&) = {general_box, lattice_box, box_of_any_size, point_box};
  Boxes boxes(std::uniform_int_distribution<std::size_t>(0, 80)(random));
  for (Box& box : boxes) box = kFamilies[family % std::size(kFamilies)](random);
  for (std::size_t copy = 1; copy < boxes.size(); copy += 7) boxes[copy] = boxes[copy / 2];
  return boxes;
}

Box cube(const Vec3& centre, double size) {
  return {centre - Vec3::Constant(size / 2), centre + Vec3::Constant(size / 2)};
}

/// Boxes of about the same size that fill a cube of edge 1.
Boxes packing(Random& random, std::size_t count) {
  const double size = 1.2 / std::cbrt(static_cast<double>(count));
  Boxes boxes(count);
  for (Box& box : boxes) {
    const Vec3 centre(uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1));
    box = cube(centre, size * uniform(random, 0.8, 1.2));
  }
  return boxes;
}

void walk(Boxes& boxes, Random& random, double length) {
  for (Box& box : boxes) {
    const Vec3 step(uniform(random, -length, length), uniform(random, -length, length),
                    uniform(random, -length, length));
    box.lower += step;
    box.upper += step;
  }
}

TEST(BroadPhase, FindsThePairsOfTheDefinitionInOrderInAThousandScenes) {
  Random random(1);
  for (std::size_t scene = 0; scene < 1000; ++scene) {
    SCOPED_TRACE(scene);
    const Boxes boxes = random_scene(random, scene);

    ASSERT_EQ(self_pairs(broad_phase_of(boxes)), self_pairs_by_definition(boxes));
  }
}

TEST(BroadPhase, FindsThePairsBetweenTwoSetsInAThousandScenes) {
  Random random(2);
  for (std::size_t scene = 0; scene < 1000; ++scene) {
    SCOPED_TRACE(scene);
    const Boxes boxes = random_scene(random, scene);
    const Boxes others = random_scene(random, scene + scene / 4);

    const Pairs pairs = pairs_between(broad_phase_of(boxes), broad_phase_of(others));

    ASSERT_EQ(pairs, pairs_between_by_definition(boxes, others));
  }
}

TEST(BroadPhase, AnswersAQueryWithTheIndicesInOrderInAThousandScenes) {
  Random random(3);
  for (std::size_t scene = 0; scene < 1000; ++scene) {
    SCOPED_TRACE(scene);
    const Boxes boxes = random_scene(random, scene);
    const Boxes wanted = random_scene(random, scene);
    const BroadPhase broad_phase = broad_phase_of(boxes);
    for (const Box& box : wanted) {
      std::vector<std::int32_t> expected;
      for (const IndexPair& pair : pairs_between_by_definition({box}, boxes))
        expected.push_back(pair.b);

      std::vector<std::int32_t> indices{99};
      broad_phase.query(box, indices);

      ASSERT_EQ(indices, expected);
    }
  }
}

TEST(BroadPhase, FindsThePairsOfMovedBoxesAfterARefit) {
  Random random(4);
  for (std::size_t scene = 0; scene < 200; ++scene) {
    SCOPED_TRACE(scene);
    Boxes boxes = random_scene(random, scene);
    BroadPhase broad_phase = broad_phase_of(boxes);
    for (int step = 0; step < 10; ++step) {
      walk(boxes, random, 0.3);
      if (step == 5) std::shuffle(boxes.begin(), boxes.end(), random);

      broad_phase.refit(boxes);

      ASSERT_EQ(self_pairs(broad_phase), self_pairs_by_definition(boxes));
    }
  }
}

TEST(BroadPhase, KeepsItsPairsRightWhileManyBoxesWanderFarWithoutARebuild) {
  Random random(5);
  Boxes boxes = packing(random, 1500);
  const Boxes fixed = packing(random, 200);
  BroadPhase broad_phase = broad_phase_of(boxes);
  const BroadPhase other = broad_phase_of(fixed);
  for (int step = 1; step <= 300; ++step) {
    walk(boxes, random, 0.05);
    broad_phase.refit(boxes);
    if (step % 50 != 0) continue;

    EXPECT_EQ(self_pairs(broad_phase), self_pairs_by_definition(boxes));
    EXPECT_EQ(pairs_between(broad_phase, other), pairs_between_by_definition(boxes, fixed));
  }
}

TEST(BroadPhase, FindsTheSamePairsOnAnyNumberOfThreads) {
  Random random(7);
  for (const std::size_t count : {0u, 1u, 2u, 5u, 1000u}) {
    const BroadPhase broad_phase = broad_phase_of(packing(random, count));
    for (const int threads : {1, 2, 3, 8}) {
      ThreadPool pool(threads);
      Pairs pairs;
      broad_phase.self_pairs(pairs, pool);
      EXPECT_EQ(pairs, self_pairs(broad_phase));
    }
  }
}

TEST(BroadPhase, LeavesOutPairsThatAreNotWanted) {
  Random random(8);
  const BroadPhase broad_phase = broad_phase_of(packing(random, 1000));
  const auto is_wanted = [](const IndexPair& pair) { return (pair.a + pair.b) % 3 == 0; };
  Pairs wanted = self_pairs(broad_phase);
  std::erase_if(wanted, [&](const IndexPair& pair) { return !is_wanted(pair); });
  ASSERT_FALSE(wanted.empty());
  for (const int threads : {1, 3}) {
    ThreadPool pool(threads);
    Pairs pairs;
    broad_phase.self_pairs(pairs, pool, is_wanted);
    EXPECT_EQ(pairs, wanted);
  }
}

TEST(BroadPhase, FindsEachWantedPairInOneOfAnyNumberOfShares) {
  Random random(11);
  const Boxes boxes = packing(random, 1000);
  const auto is_wanted = [](const IndexPair& pair) { return (pair.a + pair.b) % 3 != 0; };
  Pairs expected = self_pairs_by_definition(boxes);
  std::erase_if(expected, [&](const IndexPair& pair) { return !is_wanted(pair); });
  ASSERT_GT(expected.size(), 100U);
  const BroadPhase broad_phase = broad_phase_of(boxes);
  ThreadPool pool(2);
  for (const std::size_t count : {1U, 2U, 5U, 500U}) {
    Pairs all;
    for (std::size_t part = 0; part < count; ++part) {
      Pairs pairs{{7, 8}};
      broad_phase.self_pairs(pairs, pool, is_wanted, {part, count});
      EXPECT_TRUE(std::ranges::is_sorted(pairs));
      all.insert(all.end(), pairs.begin(), pairs.end());
    }
    std::ranges::sort(all);
    EXPECT_EQ(all, expected) << count << " shares";
  }
}

TEST(BroadPhase, CanBeRebuiltWithAnotherNumberOfBoxes) {
  Random random(6);
  BroadPhase broad_phase;
  for (const std::size_t count : {3u, 50u, 1u, 0u, 2u, 500u, 500u, 0u, 17u}) {
    const Boxes boxes = packing(random, count);

    broad_phase.rebuild(boxes);

    EXPECT_EQ(broad_phase.size(), count);
    EXPECT_EQ(self_pairs(broad_phase), self_pairs_by_definition(boxes));
  }
}

TEST(BroadPhase, WithoutBoxesFindsNothing) {
  const BroadPhase empty;
  const BroadPhase one = broad_phase_of({cube(Vec3::Zero(), 1.0)});
  std::vector<std::int32_t> indices{1};

  empty.query(cube(Vec3::Zero(), 1.0), indices);

  EXPECT_EQ(indices, std::vector<std::int32_t>{});
  EXPECT_EQ(self_pairs(empty), Pairs{});
  EXPECT_EQ(self_pairs(one), Pairs{});
  EXPECT_EQ(pairs_between(empty, one), Pairs{});
  EXPECT_EQ(pairs_between(one, empty), Pairs{});
  EXPECT_EQ(pairs_between(one, one), (Pairs{{0, 0}}));
}

TEST(BroadPhase, CountsBoxesThatTouchAtAFaceAnEdgeOrACornerButNotAcrossTheSmallestGap) {
  const Box unit{Vec3::Zero(), Vec3::Ones()};
  for (const Vec3& offset : {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 1), Vec3(-1, 1, -1)}) {
    const Box touching{unit.lower + offset, unit.upper + offset};
    Box apart = touching;
    // The x interval touches at 1 or at 0; move it off by one step of the numbers.
    apart.lower.x() = offset.x() > 0 ? std::nextafter(1.0, 2.0) : -1.0;
    apart.upper.x() = offset.x() > 0 ? 2.0 : std::nextafter(0.0, -1.0);

    EXPECT_EQ(self_pairs(broad_phase_of({unit, touching})), (Pairs{{0, 1}}));
    EXPECT_EQ(self_pairs(broad_phase_of({unit, apart})), Pairs{});
  }
}

TEST(BroadPhase, PairsEveryBoxOfAHeapOfIdenticalOnesAlsoAfterManyRefits) {
  constexpr std::size_t kCount = 400;
  const Boxes boxes(kCount, Box{Vec3::Ones(), Vec3::Ones()});
  BroadPhase broad_phase = broad_phase_of(boxes);

  for (int step = 0; step < 100; ++step) broad_phase.refit(boxes);

  EXPECT_EQ(self_pairs(broad_phase), self_pairs_by_definition(boxes));
  EXPECT_EQ(self_pairs(broad_phase).size(), kCount * (kCount - 1) / 2);
}

TEST(BroadPhase, TakesBoxesWithoutBoundsAndNeverMissesAPairOfASpoiltBox) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Boxes boxes{cube(Vec3(5, 5, 5), 1.0),
                    {Vec3::Constant(-kInfinity), Vec3::Constant(kInfinity)},
                    {Vec3(-kInfinity, -kInfinity, -kInfinity), Vec3(kInfinity, kInfinity, 0.0)},
                    {Vec3::Constant(kNan), Vec3::Constant(kNan)},
                    {Vec3::Constant(-1e308), Vec3::Constant(-1e300)}};

  EXPECT_EQ(self_pairs(broad_phase_of(boxes)),
            (Pairs{{0, 1}, {0, 3}, {1, 2}, {1, 3}, {1, 4}, {2, 3}, {2, 4}, {3, 4}}));
}

TEST(BroadPhase, RefusesToRefitAnotherNumberOfBoxes) {
  BroadPhase broad_phase = broad_phase_of({cube(Vec3::Zero(), 1.0), cube(Vec3::Ones(), 1.0)});

  try {
    broad_phase.refit(Boxes(3, cube(Vec3::Zero(), 1.0)));
    FAIL() << "nothing was thrown";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()),
              "BroadPhase::refit: got 3 boxes, expected 2 as in the last rebuild; call rebuild "
              "when boxes come or go");
  }
}

TEST(BroadPhase, KeepsItsBoxesWhenMoved) {
  BroadPhase source = broad_phase_of({cube(Vec3::Zero(), 1.0), cube(Vec3::Ones(), 1.0)});

  const BroadPhase target = std::move(source);

  EXPECT_EQ(self_pairs(target), (Pairs{{0, 1}}));
}

}  // namespace
}  // namespace broad_phase_test
}  // namespace plekton::geometry
