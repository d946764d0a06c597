// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/region.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace plekton::geometry::region_test {
namespace {

std::vector<Region> regions() {
  return {BallRegion{{0.1, 0.2, 0.0}, 0.9}, Box{{-0.5, -0.7, -0.3}, {0.6, 0.4, 0.9}},
          CylinderRegion{{-0.5, 0.0, 0.1}, {0.6, 0.5, -0.4}, 0.5}};
}

TEST(Region, HasTheVolumeOfItsShape) {
  EXPECT_DOUBLE_EQ(volume(BallRegion{Vec3::Ones(), 2.0}), 32.0 / 3.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(volume(Box{Vec3::Zero(), {1.0, 2.0, 3.0}}), 6.0);
  EXPECT_DOUBLE_EQ(volume(CylinderRegion{Vec3::Zero(), {0.0, 3.0, 4.0}, 2.0}),
                   20.0 * std::numbers::pi);
}

// Every region cuts a segment in one piece: points along it are in up to the part it tells.
TEST(Region, TellsThePartOfASegmentThatPointsAlongItAreIn) {
  test::Random random(5);
  constexpr int kPoints = 2000;
  for (const Region& region : regions()) {
    for (int round = 0; round < 50; ++round) {
      const Vec3 x0 = random.in_cube(1.2), x1 = random.in_cube(1.2);
      int inside = 0;
      for (int i = 0; i < kPoints; ++i)
        if (contains(region, x0 + (i + 0.5) / kPoints * (x1 - x0))) ++inside;
      // Each end of the piece is known to half of the distance of two points.
      EXPECT_NEAR(segment_part_in(region, x0, x1), static_cast<double>(inside) / kPoints,
                  1.0 / kPoints);
    }
  }
}

TEST(Region, HasASegmentWithoutLengthWhollyOrNot) {
  for (const Region& region : regions()) {
    EXPECT_EQ(segment_part_in(region, Vec3::Zero(), Vec3::Zero()), 1.0);
    EXPECT_EQ(segment_part_in(region, Vec3::Ones(), Vec3::Ones()), 0.0);
  }
}

TEST(Region, LiesInItsBoundsAndTouchesThem) {
  test::Random random(6);
  for (const Region& region : regions()) {
    const Box around = bounds(region);
    Vec3 lower = Vec3::Constant(9.0), upper = Vec3::Constant(-9.0);
    for (int i = 0; i < 200000; ++i) {
      const Vec3 point = random.in_cube(1.5);
      if (!contains(region, point)) continue;
      lower = lower.cwiseMin(point);
      upper = upper.cwiseMax(point);
    }
    EXPECT_TRUE((lower.array() >= around.lower.array()).all());
    EXPECT_TRUE((upper.array() <= around.upper.array()).all());
    // 200 000 points in a cube of side 3 leave a ball or a disc of side 0.5 no gap of this size.
    EXPECT_LT((lower - around.lower).maxCoeff(), 0.1);
    EXPECT_LT((around.upper - upper).maxCoeff(), 0.1);
  }
}

TEST(Region, HoldsOfABallWhatItsShapeSays) {
  const Vec3 centre(0.3, 0.3, 0.3);
  const auto all = regions();
  EXPECT_EQ(ball_volume_in(all[0], centre, 0.7),
            lens_volume(0.7, 0.9, (centre - Vec3(0.1, 0.2, 0.0)).norm()));
  EXPECT_EQ(ball_volume_in(all[1], centre, 0.7),
            ball_volume_in_box(centre, 0.7, std::get<Box>(all[1])));
  EXPECT_EQ(ball_volume_in(all[2], centre, 0.7),
            ball_volume_in_cylinder(centre, 0.7, std::get<CylinderRegion>(all[2])));
}

}  // namespace
}  // namespace plekton::geometry::region_test
