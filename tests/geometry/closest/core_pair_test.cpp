// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/core_pair.hpp"

#include "tests/support/exact_pair.hpp"
#include "tests/support/simplex_families.hpp"

#include <gtest/gtest.h>

namespace plekton::geometry::core_pair_test {
namespace {

Core core_of(std::span<const Vec3> corners) {
  Core core;
  for (const Vec3& x : corners) core.x[core.count++] = x;
  return core;
}

/// All nine combinations of points, segments and triangles.
template <class Check>
void for_all_kinds(const test::SimplexPair<3, 3>& pair, Check check) {
  for (std::size_t count_a = 1; count_a <= 3; ++count_a) {
    for (std::size_t count_b = 1; count_b <= 3; ++count_b)
      check(core_of({pair.a.data(), count_a}), core_of({pair.b.data(), count_b}));
  }
}

TEST(CoreProximity, HasAUnitNormalAndATrueDistanceForCoresOfAllKinds) {
  test::SimplexFamilies<3, 3> families(1);
  for (std::size_t f = 0; f < test::kPairFamilies.size(); ++f) {
    SCOPED_TRACE(test::kPairFamilyNames[f]);
    for (int trial = 0; trial < 300 && !::testing::Test::HasNonfatalFailure(); ++trial) {
      for_all_kinds(families.draw(test::kPairFamilies[f]), [](const Core& a, const Core& b) {
        const CoreProximity found = core_proximity(a, b);
        const test::Judgement judgement = test::judge(a.corners(), b.corners(), found.points);

        EXPECT_NEAR(found.normal.norm(), 1.0, 1e-15);
        EXPECT_FALSE(judgement.wrong_region || judgement.wrong_relation || judgement.not_a_number);
        if (found.points.relation == Relation::apart) {
          EXPECT_EQ(found.signed_distance, found.points.distance);
          EXPECT_LE((found.points.separation - found.signed_distance * found.normal).norm(),
                    1e-15 * found.signed_distance);
        } else {
          EXPECT_LE(found.signed_distance, 0.0);
        }
      });
    }
  }
}

TEST(CoreProximity, GoesOutAlongTheAskedSide) {
  const Core sheet = core_of(std::array{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)});
  const Core bar = core_of(std::array{Vec3(1, 1, -1), Vec3(1, 1, 1)});

  EXPECT_EQ(core_proximity(sheet, bar, Vec3(0, 0, 1)).normal, Vec3(0, 0, 1));
  EXPECT_EQ(core_proximity(sheet, bar, Vec3(0, 0, -1)).normal, Vec3(0, 0, -1));
  EXPECT_EQ(core_proximity(sheet, bar).signed_distance, -1.0);
}

TEST(CoreProximity, OfAPointOnAnEdgeDependsOnTheEdgeAlone) {
  const Vec3 from(0, 0, 0);
  const Vec3 to(4, 2, 8);
  const Core point = core_of(std::array{Vec3(1, 0.5, 2)});

  const CoreProximity first = core_proximity(point, core_of(std::array{from, to, Vec3(9, 1, 0)}));
  const CoreProximity second = core_proximity(point, core_of(std::array{from, to, Vec3(-1, 5, 3)}));

  EXPECT_EQ(first.normal, second.normal);
  EXPECT_EQ(first.points.weights_b, second.points.weights_b);
  EXPECT_EQ(first.signed_distance, 0.0);
}

TEST(CoreProximity, GivesTheSameBitsWithAnyGuess) {
  // Also with that of cores that crossed, a side and a face, which no nearest points have.
  test::SimplexFamilies<3, 3> families(2);
  std::size_t crossings = 0;
  for (const auto family : test::kPairFamilies) {
    for (int trial = 0; trial < 100 && !::testing::Test::HasNonfatalFailure(); ++trial) {
      for_all_kinds(families.draw(family), [&](const Core& a, const Core& b) {
        const CoreProximity plain = core_proximity(a, b);
        crossings += plain.points.relation == Relation::touching_or_crossing;
        for (unsigned of_a = 1; of_a < 1U << a.count; ++of_a) {
          for (unsigned of_b = 1; of_b < 1U << b.count; ++of_b) {
            const CoreProximity guessed =
                core_proximity(a, b, closest::WitnessFeatures{of_a, of_b});
            EXPECT_EQ(guessed.points.relation, plain.points.relation);
            EXPECT_EQ(guessed.points.weights_a, plain.points.weights_a);
            EXPECT_EQ(guessed.points.weights_b, plain.points.weights_b);
            EXPECT_EQ(guessed.normal, plain.normal);
            EXPECT_EQ(guessed.signed_distance, plain.signed_distance);
          }
        }
      });
    }
  }
  EXPECT_GT(crossings, 100u);
}

Vec3 point_on(const Core& core, const Vec3& weights) {
  Vec3 point = Vec3::Zero();
  for (std::size_t i = 0; i < core.count; ++i) point += weights[static_cast<int>(i)] * core.x[i];
  return point;
}

/// Two cores of two or three corners in a cube of side 2 about its middle: many of them cross.
std::array<Core, 2> crossing_cores(test::Random& random) {
  std::array<Core, 2> cores;
  for (Core& core : cores) {
    core.count = random.coin() ? 3 : 2;
    for (std::size_t i = 0; i < core.count; ++i) core.x[i] = random.in_cube(1.0);
  }
  return cores;
}

TEST(AtLastTouch, HasPointsThatAreTheDepthApart) {
  test::Random random(3);
  int crossings = 0;
  for (int trial = 0; trial < 5000 && !::testing::Test::HasFailure(); ++trial) {
    const auto [a, b] = crossing_cores(random);
    const CoreProximity found = core_proximity(a, b);
    const CoreProximity last = at_last_touch(a, b, found);

    EXPECT_EQ(last.normal, found.normal);
    EXPECT_EQ(last.signed_distance, found.signed_distance);
    EXPECT_EQ(last.points.relation, found.points.relation);
    const Vec3 way = point_on(b, last.points.weights_b) - point_on(a, last.points.weights_a);
    EXPECT_LE((way - last.signed_distance * last.normal).norm(), 1e-11) << trial;
    EXPECT_GE(std::min(last.points.weights_a.minCoeff(), last.points.weights_b.minCoeff()), 0.0);
    EXPECT_NEAR(last.points.weights_a.sum(), 1.0, 1e-15);
    EXPECT_NEAR(last.points.weights_b.sum(), 1.0, 1e-15);
    crossings += found.signed_distance < 0.0 ? 1 : 0;
  }
  EXPECT_GT(crossings, 500);
}

// A side that lies in the plane of a facet, or two parallel ones, have a kink: of corners at random
// they are rare, and left out where both one-sided differences are unlike each other.
TEST(AtLastTouch, HasTheSlopeOfTheSignedDistanceAsWeights) {
  test::Random random(4);
  constexpr double kStep = 1e-7;
  int crossings = 0, kinks = 0;
  for (int trial = 0; trial < 5000 && !::testing::Test::HasFailure(); ++trial) {
    auto [a, b] = crossing_cores(random);
    const CoreProximity found = at_last_touch(a, b, core_proximity(a, b));
    if (!(found.signed_distance < -0.01)) continue;
    ++crossings;
    for (Core* moving : {&a, &b}) {
      for (std::size_t i = 0; i < moving->count; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
          double& x = moving->x[i][axis];
          const double at = x;
          x = at + kStep;
          const double ahead = core_proximity(a, b).signed_distance;
          x = at - kStep;
          const double behind = core_proximity(a, b).signed_distance;
          x = at;
          if (std::abs(ahead - 2.0 * found.signed_distance + behind) > 1e-4 * kStep) {
            ++kinks;
            continue;
          }
          const Vec3& weights =
              moving == &a ? found.points.weights_a : found.points.weights_b;
          const double sign = moving == &a ? -1.0 : 1.0;
          EXPECT_NEAR((ahead - behind) / (2.0 * kStep),
                      sign * weights[static_cast<int>(i)] * found.normal[axis], 1e-4)
              << trial;
        }
      }
    }
  }
  EXPECT_GT(crossings, 500);
  EXPECT_LT(kinks, crossings / 20);
}

TEST(AtLastTouch, LeavesCoresThatAreApartOrTouchAsTheyAre) {
  const Core sheet = core_of(std::array{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)});
  for (const double height : {0.0, 1.0}) {
    const Core bar = core_of(std::array{Vec3(1, 1, height), Vec3(1, 1, 3)});
    const CoreProximity found = core_proximity(sheet, bar);
    const CoreProximity last = at_last_touch(sheet, bar, found);

    EXPECT_EQ(last.points.weights_a, found.points.weights_a);
    EXPECT_EQ(last.points.weights_b, found.points.weights_b);
  }
}

TEST(CorePair, HasADistanceAndADirectionWhereTheSquareOfTheDistanceVanishes) {
  const Core facet{{Vec3(-1, -1, 0), Vec3(2, -1, 0), Vec3(-1, 2, 0)}, 3};
  const Core bar{{Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3::Zero()}, 2};
  for (const double gap : {1e-150, 1e-154, 1e-162, 1e-200, 1e-300}) {
    const Core point{{Vec3(0, 0, gap), Vec3::Zero(), Vec3::Zero()}, 1};
    for (const Core& below : {facet, bar}) {
      const CoreProximity found = core_proximity(point, below);
      EXPECT_EQ(found.points.relation, Relation::apart);
      EXPECT_NEAR(found.signed_distance, gap, 1e-12 * gap);
      EXPECT_NEAR((found.normal - Vec3(0, 0, -1)).norm(), 0.0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace plekton::geometry::core_pair_test
