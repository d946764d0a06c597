// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/ball_volume.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace plekton::geometry::ball_volume_test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 64.0 * std::numeric_limits<double>::epsilon();

/// Part of points in the ball that is_in says are in the region, and its standard deviation.
struct Sampled {
  double volume;
  double deviation;
};

template <class IsIn>
Sampled sampled(const Vec3& centre, double radius, IsIn is_in, test::Random& random) {
  constexpr int kPoints = 200000;
  int inside = 0;
  for (int i = 0; i < kPoints; ++i) {
    Vec3 point = random.in_cube(1.0);
    while (point.squaredNorm() > 1.0) point = random.in_cube(1.0);
    if (is_in(Vec3(centre + radius * point))) ++inside;
  }
  const double part = static_cast<double>(inside) / kPoints;
  return {part * ball_volume(radius),
          std::sqrt(std::max(part * (1.0 - part), 1.0 / kPoints) / kPoints) * ball_volume(radius)};
}

TEST(BallVolume, OfACapIsThatOfTheHalfBallAndOfTheWholeOne) {
  EXPECT_DOUBLE_EQ(cap_volume(2.0, 0.0), 0.5 * ball_volume(2.0));
  EXPECT_DOUBLE_EQ(cap_volume(2.0, -2.0), ball_volume(2.0));
  EXPECT_DOUBLE_EQ(cap_volume(2.0, -7.0), ball_volume(2.0));
  EXPECT_EQ(cap_volume(2.0, 2.0), 0.0);
  // pi h² (3 r - h) / 3 with h = 1/2, r = 2.
  EXPECT_DOUBLE_EQ(cap_volume(2.0, 1.5), kPi * 0.25 * 5.5 / 3.0);
}

TEST(BallVolume, OfALensIsTheFormulaOfTheHandbook) {
  // Weisstein, "Sphere-Sphere Intersection": equal balls at a distance d, pi (4 R + d)(2 R - d)²/12.
  EXPECT_DOUBLE_EQ(lens_volume(1.0, 1.0, 0.6), kPi / 12.0 * 4.6 * 1.4 * 1.4);
  EXPECT_DOUBLE_EQ(lens_volume(1.0, 3.0, 0.5), ball_volume(1.0));
  EXPECT_EQ(lens_volume(1.0, 3.0, 4.0), 0.0);
  // Unequal ones, ibid.: pi (R + r - d)² (d² + 2 d r - 3 r² + 2 d R + 6 r R - 3 R²) / (12 d).
  const double r = 1.0, R = 1.7, d = 2.2;
  EXPECT_NEAR(lens_volume(r, R, d),
              kPi * std::pow(R + r - d, 2) *
                  (d * d + 2 * d * r - 3 * r * r + 2 * d * R + 6 * r * R - 3 * R * R) / (12 * d),
              kRounding);
}

TEST(BallVolume, OfABallAroundTheCornerOfABoxIsAnEighth) {
  const Box box{Vec3::Zero(), Vec3::Constant(5.0)};
  EXPECT_NEAR(ball_volume_in_box(Vec3::Zero(), 2.0, box), ball_volume(2.0) / 8.0, 8.0 * kRounding);
  EXPECT_NEAR(ball_volume_in_box({0.0, 0.0, 2.5}, 2.0, box), ball_volume(2.0) / 4.0,
              8.0 * kRounding);
  EXPECT_EQ(ball_volume_in_box({2.5, 2.5, 2.5}, 2.0, box), ball_volume(2.0));
  EXPECT_EQ(ball_volume_in_box({-2.0, 2.5, 2.5}, 2.0, box), 0.0);
  // One face alone: a cap.
  EXPECT_NEAR(ball_volume_in_box({0.5, 2.5, 2.5}, 2.0, box), cap_volume(2.0, -0.5),
              8.0 * kRounding);
}

TEST(BallVolume, OfBoxesThatFillSpaceAddsUpToTheBall) {
  test::Random random(3);
  for (int round = 0; round < 200; ++round) {
    const Vec3 cut = random.in_cube(1.2);
    const Vec3 centre = random.in_cube(0.3);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      Box box{cut, cut};
      for (int axis = 0; axis < 3; ++axis)
        (((corner >> axis) & 1) != 0 ? box.upper : box.lower)[axis] += corner >> axis & 1 ? 9 : -9;
      sum += ball_volume_in_box(centre, 1.0, box);
    }
    EXPECT_NEAR(sum, ball_volume(1.0), 8.0 * kRounding);
  }
}

// Of 60 estimates one is further off than 4 deviations once in 260 times; the seed is fixed.
TEST(BallVolume, OfABoxIsWhatRandomPointsSay) {
  test::Random random(11);
  for (int round = 0; round < 30; ++round) {
    const Vec3 a = random.in_cube(1.0), b = random.in_cube(1.0);
    const Box box{a.cwiseMin(b), a.cwiseMax(b)};
    const Vec3 centre = random.in_cube(0.5);
    const auto expected = sampled(
        centre, 0.8,
        [&](const Vec3& p) {
          return (p.array() >= box.lower.array()).all() && (p.array() <= box.upper.array()).all();
        },
        random);
    EXPECT_NEAR(ball_volume_in_box(centre, 0.8, box), expected.volume, 4.0 * expected.deviation);
  }
}

TEST(BallVolume, OfACylinderIsWhatRandomPointsSay) {
  test::Random random(12);
  for (int round = 0; round < 30; ++round) {
    const Vec3 from = random.in_cube(1.0);
    const Vec3 axis = random.direction();
    const CylinderRegion cylinder{from, from + random.uniform(0.2, 2.0) * axis,
                                  random.uniform(0.2, 1.5)};
    const double length = (cylinder.to - cylinder.from).norm();
    const Vec3 centre = random.in_cube(1.0);
    const auto expected = sampled(
        centre, 0.8,
        [&](const Vec3& p) {
          const double height = axis.dot(p - from);
          return height >= 0.0 && height <= length &&
                 (p - from - height * axis).norm() <= cylinder.radius;
        },
        random);
    EXPECT_NEAR(ball_volume_in_cylinder(centre, 0.8, cylinder), expected.volume,
                4.0 * expected.deviation);
  }
}

// A cylinder of radius a through the centre of a ball of radius R leaves 4 pi (R² - a²)^(3/2) / 3
// (the napkin ring).
TEST(BallVolume, OfACylinderThroughTheCentreIsTheBallLessTheNapkinRing) {
  const CylinderRegion cylinder{{0.0, 0.0, -5.0}, {0.0, 0.0, 5.0}, 0.6};
  EXPECT_NEAR(ball_volume_in_cylinder(Vec3::Zero(), 1.0, cylinder),
              ball_volume(1.0) - ball_volume(0.8), 1e-10);
}

// Viviani: a cylinder of half the radius through the centre of the unit ball has
// 2 pi / 3 - 8 / 9 of it.
TEST(BallVolume, OfVivianisCylinderIsTheClosedForm) {
  const CylinderRegion cylinder{{0.5, 0.0, -5.0}, {0.5, 0.0, 5.0}, 0.5};
  EXPECT_NEAR(ball_volume_in_cylinder(Vec3::Zero(), 1.0, cylinder), 2.0 * kPi / 3.0 - 8.0 / 9.0,
              1e-10);
}

// A wide cylinder is nearly a half-space: the cap less than its circumference bends away.
TEST(BallVolume, OfAWideCylinderIsNearlyThatOfACap) {
  const CylinderRegion cylinder{{0.0, 0.0, -50.0}, {0.0, 0.0, 50.0}, 1e6};
  EXPECT_NEAR(ball_volume_in_cylinder({1e6 - 0.3, 0.0, 0.0}, 1.0, cylinder), cap_volume(1.0, -0.3),
              1e-5);
}

TEST(BallVolume, OfAPointIsNothing) {
  EXPECT_EQ(ball_volume_in_box(Vec3::Zero(), 0.0, {Vec3::Zero(), Vec3::Ones()}), 0.0);
  EXPECT_EQ(ball_volume_in_cylinder(Vec3::Zero(), 0.0, {{0, 0, -1}, {0, 0, 1}, 1.0}), 0.0);
  EXPECT_EQ(lens_volume(0.0, 1.0, 0.2), 0.0);
}

}  // namespace
}  // namespace plekton::geometry::ball_volume_test
