// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/grains/sphere_packing.hpp"

#include "apps/grains/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace plekton::apps::sphere_packing_test {
namespace {

/// Equal spheres of radius 1 that shall fill a part of a space, small and apart at first.
struct Sparse {
  std::vector<Vec3> centres;
  std::vector<double> radii;
  double factor = 0.0;
};

Sparse sparse(std::size_t count, double filled, const Container& container) {
  Random random(4);
  Sparse made{{}, std::vector<double>(count, 1.0), std::cbrt(0.15 / filled)};
  FreeSpace space(container.bounds, made.factor, {});
  while (made.centres.size() < count) {
    const Vec3 centre = random.in_box(container.bounds.lower, container.bounds.upper);
    if (!space.has_room(centre, made.factor) || !container.holds(centre, made.factor)) continue;
    space.add({{centre, centre, centre}, made.factor});
    made.centres.push_back(centre);
  }
  return made;
}

/// A cube that so many spheres of radius 1 fill to a part.
Container cube(std::size_t count, double filled) {
  const double side = std::cbrt(static_cast<double>(count) * geometry::ball_volume(1.0) / filled);
  return container_of(Box{Vec3::Zero(), Vec3::Constant(side)});
}

SpherePacking packing_of(const Sparse& made, const Container& container,
                         const PackingWalls& walls = {}) {
  return SpherePacking(made.centres, made.radii, made.factor, container, walls);
}

double least_gap(const std::vector<Vec3>& x, double radius) {
  double least = 1e9;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, (x[i] - x[j]).norm());
  return least - 2.0 * radius;
}

TEST(SpherePacking, GrowsToADensityThatChanceDoesNotReachWithoutOverlap) {
  // Random sequential placement ends at 0.38.
  const Container container = cube(300, 0.52);
  SpherePacking packing = packing_of(sparse(300, 0.52, container), container);

  ASSERT_TRUE(packing.grow_to(1.0));

  EXPECT_DOUBLE_EQ(packing.factor(), 1.0);
  EXPECT_GE(least_gap(packing.centres(), 1.0), 0.0);
  for (const Vec3& centre : packing.centres()) {
    EXPECT_GE(centre.minCoeff(), 1.0);
    EXPECT_LE(centre.maxCoeff(), container.bounds.upper[0] - 1.0);
  }
}

TEST(SpherePacking, StaysInACylinderOfAnyDirection) {
  const Vec3 axis = Vec3(1.0, 2.0, -1.0).normalized();
  const geometry::CylinderRegion cylinder{{3.0, 0.0, 0.0}, Vec3(3.0, 0.0, 0.0) + 12.0 * axis, 6.0};
  const Container container = container_of(cylinder);
  const auto count = static_cast<std::size_t>(0.5 * container.volume / geometry::ball_volume(1.0));
  SpherePacking packing = packing_of(sparse(count, 0.5, container), container);

  ASSERT_TRUE(packing.grow_to(1.0));

  EXPECT_GE(least_gap(packing.centres(), 1.0), 0.0);
  for (const Vec3& centre : packing.centres()) EXPECT_TRUE(container.holds(centre, 1.0));
}

// Equal frictionless spheres jam at 0.64 far from walls; at walls they are looser. Denser than
// 0.645 would be a crystal.
TEST(SpherePacking, JamsWhereRandomPackingsEnd) {
  const Container container = cube(400, 0.7);
  SpherePacking packing = packing_of(sparse(400, 0.7, container), container);

  EXPECT_FALSE(packing.grow_to(1.0));

  const double filled = 0.7 * std::pow(packing.factor(), 3);
  EXPECT_GT(filled, 0.55);
  EXPECT_LT(filled, 0.645);
  EXPECT_GE(least_gap(packing.centres(), packing.factor()), 0.0);
}

// A crystal of one sphere in a cube: pressed on by six walls with E r times the overlap each.
TEST(SpherePacking, PressesOneSphereInACubeAsTheSpringsSay) {
  const Container container = container_of(Box{Vec3::Zero(), Vec3::Constant(2.0)});
  SpherePacking packing({Vec3::Constant(1.0)}, {1.0}, 0.5, container, {});

  packing.grow_to(2.0);
  ASSERT_TRUE(packing.press_to(1e-3));

  // 6 forces r (r - 1) at a distance of 1, over 3 volumes of 8: r (r - 1) / 4.
  const double r = packing.factor();
  EXPECT_NEAR(r * (r - 1.0) / 4.0, 1e-3, 1e-5);
  EXPECT_NEAR(packing.pressure(), r * (r - 1.0) / 4.0, 1e-9);
}

TEST(SpherePacking, CountsAPlaneAlongASideOfItsContainerOnce) {
  const Container container = container_of(Box{Vec3::Zero(), Vec3::Constant(2.0)});
  std::vector<contact::Plane> planes;
  for (int axis = 0; axis < 3; ++axis) {
    planes.push_back({Vec3(7.0, 7.0, 7.0) - 7.0 * Vec3::Unit(axis), Vec3::Unit(axis)});
    planes.push_back({Vec3::Constant(2.0), -Vec3::Unit(axis)});
  }
  SpherePacking alone({Vec3::Constant(1.0)}, {1.0}, 0.5, container, {});
  SpherePacking walled({Vec3::Constant(1.0)}, {1.0}, 0.5, container, {{}, planes, {}});

  alone.grow_to(2.0);
  walled.grow_to(2.0);
  ASSERT_TRUE(alone.press_to(1e-3));
  ASSERT_TRUE(walled.press_to(1e-3));

  EXPECT_DOUBLE_EQ(walled.factor(), alone.factor());
}

TEST(SpherePacking, CountsAContainerAlongItsSideOnce) {
  const geometry::CylinderRegion region{Vec3::Zero(), Vec3(0.0, 0.0, 6.0), 3.0};
  const Container container = container_of(region);
  const std::vector<contact::Plane> planes = {{.point = Vec3(0.0, 0.0, 99.0),
                                               .normal = Vec3::Zero(),
                                               .form = contact::Plane::Form::cylinder,
                                               .radius = 3.0,
                                               .axis = -Vec3::UnitZ()}};
  std::vector<Vec3> centres;
  for (const double z : {1.5, 4.5}) {
    centres.push_back(Vec3(1.0, 0.5, z));
    centres.push_back(Vec3(-1.0, -0.5, z));
  }
  const std::vector<double> radii(4, 1.0);
  SpherePacking alone(centres, radii, 0.5, container, {});
  SpherePacking walled(centres, radii, 0.5, container, {{}, planes, {}});

  alone.grow_to(3.0);
  walled.grow_to(3.0);
  ASSERT_TRUE(alone.press_to(1e-3));
  ASSERT_TRUE(walled.press_to(1e-3));

  EXPECT_NEAR(walled.factor(), alone.factor(), 1e-9);
}

// Springs of both sides in series: 2 e r / (1 + e) of a plane with e times the modulus, and
// 2 r s / (r + s) of an obstacle with a spring s; here 1.5 r and 0.5 r.
TEST(SpherePacking, HasTheSpringsOfItsWalls) {
  const Container container = container_of(Box{Vec3::Constant(-9.0), Vec3::Constant(9.0)});
  const double size = 2.0;
  std::vector<contact::Plane> planes;
  std::vector<Obstacle> obstacles;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 normal = Vec3::Unit(axis);
    planes.push_back({Vec3::Zero(), normal});
    const Vec3 u = Vec3::Unit((axis + 1) % 3), v = Vec3::Unit((axis + 2) % 3);
    const Vec3 corner = (size + 0.1) * normal - 9.0 * (u + v);
    obstacles.push_back({{corner, corner + 40.0 * u, corner + 40.0 * v}, 0.1, 1.0 / 3.0});
  }
  const std::vector<double> moduli(3, 3.0);
  SpherePacking packing({Vec3::Constant(1.0)}, {1.0}, 0.5, container, {obstacles, planes, moduli});

  packing.grow_to(2.0);
  ASSERT_TRUE(packing.press_to(1e-6));

  // 3 forces on each side, equal in balance: k_a (r - d) = k_b (r - size + d), moments F size.
  const double r = packing.factor();
  const double of_planes = 1.5 * r, of_obstacles = 2.0 * r / (3.0 * r + 1.0);
  const double d = (of_planes * r - of_obstacles * (r - size)) / (of_planes + of_obstacles);
  const double force = of_planes * (r - d);
  EXPECT_NEAR(packing.pressure(), 3.0 * force * size / (3.0 * container.volume), 1e-3 * 1e-6);
  EXPECT_NEAR(packing.centres()[0][0], d, 1e-6);
}

TEST(SpherePacking, PressesSpheresToAPressureInEquilibrium) {
  const Container container = cube(150, 0.6);
  SpherePacking packing = packing_of(sparse(150, 0.6, container), container);

  packing.grow_to(2.0);
  ASSERT_TRUE(packing.press_to(1e-3));

  EXPECT_NEAR(packing.pressure(), 1e-3, 1e-5);
}

TEST(SpherePacking, GoesAroundWhatIsThere) {
  const Container container = cube(200, 0.45);
  const double side = container.bounds.upper[0];
  const double middle = 0.5 * side;
  // A wall across half of the cube, as a triangle, and a ball.
  const std::vector<Obstacle> obstacles{
      {{Vec3(0.0, 0.0, middle), Vec3(side, 0.0, middle), Vec3(0.0, side, middle)}, 0.1},
      {{Vec3(middle, middle, 2.0), Vec3(middle, middle, 2.0), Vec3(middle, middle, 2.0)}, 1.5}};
  Random random(4);
  Sparse made{{}, std::vector<double>(200, 1.0), 0.6};
  FreeSpace space(container.bounds, made.factor, {});
  for (const Obstacle& obstacle : obstacles) space.add(obstacle);
  while (made.centres.size() < 200) {
    const Vec3 centre = random.in_box(container.bounds.lower, container.bounds.upper);
    if (!space.has_room(centre, made.factor)) continue;
    space.add({{centre, centre, centre}, made.factor});
    made.centres.push_back(centre);
  }
  const contact::Plane floor{{0.0, 0.0, 0.2}, Vec3::UnitZ()};
  SpherePacking packing = packing_of(made, container, {obstacles, {&floor, 1}});

  ASSERT_TRUE(packing.grow_to(1.0));

  for (const Vec3& centre : packing.centres()) {
    EXPECT_GE(centre[2], 1.2);
    for (const Obstacle& obstacle : obstacles)
      EXPECT_GE(distance_to_triangle(centre, obstacle.core), 1.0 + obstacle.radius);
  }
}

TEST(SpherePacking, IsTheSameEachTime) {
  const Container container = cube(100, 0.5);
  SpherePacking one = packing_of(sparse(100, 0.5, container), container);
  SpherePacking other = packing_of(sparse(100, 0.5, container), container);

  one.grow_to(1.0);
  other.grow_to(1.0);

  EXPECT_EQ(one.centres(), other.centres());
}

}  // namespace
}  // namespace plekton::apps::sphere_packing_test
