// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/base/plane.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace plekton::contact::plane_test {
namespace {

using Form = Plane::Form;
using geometry::Vec3;

constexpr double kEps = std::numeric_limits<double>::epsilon();

Plane flat_at(const Vec3& point, const Vec3& normal) {
  return {.point = point, .normal = normal, .axis = normal};
}
Plane cylinder_of(double radius, const Vec3& point, const Vec3& axis) {
  return {.point = point,
          .normal = Vec3::Zero(),
          .form = Form::cylinder,
          .radius = radius,
          .axis = axis};
}
Plane sphere_of(double radius, const Vec3& point) {
  return {.point = point,
          .normal = Vec3::Zero(),
          .form = Form::sphere,
          .radius = radius,
          .axis = Vec3::UnitZ()};
}

/// One of each form, anywhere.
std::vector<Plane> some_planes(test::Random& random) {
  return {flat_at(random.in_cube(2.0), random.direction()),
          cylinder_of(random.uniform(0.5, 3.0), random.in_cube(2.0), random.direction()),
          sphere_of(random.uniform(0.5, 3.0), random.in_cube(2.0))};
}

TEST(Plane, OfACylinderIsAsHighBelowAPlaceAsItIsFarFromTheAxis) {
  const Plane plane = cylinder_of(2.0, Vec3(1, 1, 7), Vec3::UnitZ());

  EXPECT_DOUBLE_EQ(plane.height(Vec3(1.5, 1, -4)), 1.5);
  EXPECT_EQ(plane.normal_at(Vec3(1.5, 1, -4)), Vec3(-1, 0, 0));
  EXPECT_DOUBLE_EQ(plane.height(Vec3(1, -2, 9)), -1.0);
  EXPECT_EQ(plane.normal_at(Vec3(1, -2, 9)), Vec3(0, 1, 0));
}

TEST(Plane, OfASphereIsAsHighBelowAPlaceAsItIsFarFromTheCentre) {
  const Plane plane = sphere_of(2.0, Vec3(1, 1, 7));

  EXPECT_DOUBLE_EQ(plane.height(Vec3(1, 1, 5.5)), 0.5);
  EXPECT_EQ(plane.normal_at(Vec3(1, 1, 5.5)), Vec3(0, 0, 1));
}

TEST(Plane, PushesInOneDirectionAlsoFromTheMiddleOfAContainer) {
  const Plane cylinder = cylinder_of(2.0, Vec3::Zero(), Vec3::UnitZ());
  const Vec3 normal = cylinder.normal_at(Vec3(0, 0, 5));
  EXPECT_NEAR(normal.norm(), 1.0, 2 * kEps);
  EXPECT_EQ(normal.z(), 0.0);
  EXPECT_EQ(sphere_of(2.0, Vec3::Zero()).normal_at(Vec3::Zero()).norm(), 1.0);
}

/// The foot is on the wall, the way to it is along the normal, and no step within the wall comes
/// nearer: its distance has the normal as gradient.
TEST(Plane, HasTheNormalAsTheGradientOfItsHeight) {
  test::Random random(11);
  for (int trial = 0; trial < 200; ++trial) {
    for (const Plane& plane : some_planes(random)) {
      const Vec3 x = random.in_cube(2.0);
      EXPECT_NEAR(plane.height(plane.foot(x)), 0.0, 32 * kEps);
      constexpr double kStep = 1e-6;
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 way = kStep * Vec3::Unit(axis);
        const double slope = (plane.height(x + way) - plane.height(x - way)) / (2.0 * kStep);
        // The third derivative is at most some 3 over the squared distance from the middle.
        const double curved = std::pow(kStep / (plane.foot(x) - x).norm(), 2.0);
        if (curved > 1e-6) continue;
        EXPECT_NEAR(slope, plane.normal_at(x)[axis], 1e-5);
      }
    }
  }
}

/// Bars and facets are within a wall where their nodes are.
TEST(Plane, IsNowhereNearerToASegmentThanToItsEnds) {
  test::Random random(12);
  for (int trial = 0; trial < 500; ++trial) {
    for (const Plane& plane : some_planes(random)) {
      const Vec3 a = random.in_cube(3.0), b = random.in_cube(3.0);
      const double least = std::min(plane.height(a), plane.height(b));
      for (const double t : {0.1, 0.35, 0.5, 0.8})
        EXPECT_GE(plane.height(a + t * (b - a)), least - 16 * kEps);
    }
  }
}

/// A force along the normal turns as a body moves across it: by central differences.
TEST(Plane, ResistsMotionAcrossAForceByItsCurvature) {
  test::Random random(13);
  const Plane cylinder = cylinder_of(2.0, Vec3(0.1, 0.2, 0.3), Vec3::UnitZ());
  const Vec3 x(1.1, -0.4, 0.7);
  const Vec3 across = Vec3::UnitZ().cross(cylinder.normal_at(x));
  constexpr double kForce = 7.0, kStep = 1e-6;
  const double resisted =
      -kForce *
      (cylinder.normal_at(x + kStep * across) - cylinder.normal_at(x - kStep * across))
          .dot(across) /
      (2.0 * kStep);

  EXPECT_NEAR(cylinder.turning_stiffness(x, kForce), resisted, 1e-8 * resisted);
  EXPECT_EQ(flat_at(x, Vec3::UnitX()).turning_stiffness(x, kForce), 0.0);
}

TEST(Plane, MovesAsARigidBodyThatTurnsAboutItsAxis) {
  Plane plane = cylinder_of(2.0, Vec3(1, 0, 0), Vec3::UnitZ());
  plane.velocity = Vec3(0, 0, 3);
  EXPECT_EQ(plane.velocity_at(Vec3(1, 2, 5)), Vec3(0, 0, 3));
  EXPECT_FALSE(plane.turns());

  plane.angular_velocity = 0.5;

  EXPECT_TRUE(plane.turns());
  EXPECT_EQ(plane.velocity_at(Vec3(1, 2, 5)), Vec3(-1, 0, 3));
  EXPECT_EQ(plane.turning(), Vec3(0, 0, 0.5));
}

TEST(Plane, IsToldByADirectionAndARadius) {
  EXPECT_EQ(flat_at(Vec3::Zero(), Vec3::UnitX()).direction(), Vec3::UnitX());
  EXPECT_EQ(cylinder_of(1.0, Vec3::Zero(), Vec3::UnitY()).direction(), Vec3::UnitY());
  EXPECT_EQ(sphere_of(1.0, Vec3::Zero()).direction(), Vec3::Zero());
}

TEST(Plane, ComesNearerAsFastAsItMovesAndGetsNarrowerTogether) {
  Plane cylinder = cylinder_of(2.0, Vec3::Zero(), Vec3::UnitZ());
  cylinder.velocity = Vec3(3.0, 0.0, 0.0);
  cylinder.widening = -0.5;
  cylinder.angular_velocity = 100.0;

  const Vec3 behind(-2.0, 0.0, 0.0);  // where both bring it nearer

  EXPECT_EQ(cylinder.velocity_at(behind).dot(cylinder.normal_at(behind)), 3.5);
  EXPECT_EQ(cylinder.speed(), 3.5);
}

TEST(Plane, HasNoNormalUnlessOneIsGiven) {
  const Plane ball{.point = Vec3::Zero(), .form = Form::sphere, .radius = 1.0};

  EXPECT_EQ(ball.normal, Vec3::Zero());
}

}  // namespace
}  // namespace plekton::contact::plane_test
