// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/ray.hpp"

#include "geometry/query/surface_query.hpp"
#include "tests/support/complexes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plekton::geometry::ray_test {
namespace {

using test::Complex;

/// A facet over (0, 0), (4, 0), (0, 4) in z = 0, and a capsule from (0, 0, 9) to (4, 0, 9); radius
/// 0.1 m.
Complex plate_and_bar() {
  Complex complex;
  for (const Vec3& x :
       {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0), Vec3(0, 0, 9), Vec3(4, 0, 9)}) {
    complex.node(x);
  }
  complex.facet(0, 1, 2);
  complex.cylinder(3, 4);
  return complex;
}

class RayOnAPlateAndABar : public ::testing::Test {
 protected:
  std::optional<RayHit> hit_plate(const Vec3& origin, const Vec3& direction) const {
    return hit({origin, direction}, {surface_, complex_.x}, CellId{0});
  }
  std::optional<RayHit> hit_bar(const Vec3& origin, const Vec3& direction) const {
    return hit({origin, direction}, {surface_, complex_.x}, CellId{1});
  }

  Complex complex_ = plate_and_bar();
  Surface surface_ = complex_.surface();
};

TEST_F(RayOnAPlateAndABar, HitsTheFlatSideAtTheThickness) {
  const auto found = hit_plate(Vec3(1, 1, 5), Vec3(0, 0, -2));

  ASSERT_TRUE(found.has_value());
  EXPECT_DOUBLE_EQ(found->t, 4.9 / 2.0);
  EXPECT_EQ(found->normal, Vec3(0, 0, 1));
  EXPECT_EQ(found->core.feature, Feature(FaceId{0}));
}

TEST_F(RayOnAPlateAndABar, HitsTheRoundedRimAndCorner) {
  const auto rim = hit_plate(Vec3(2, -7, 0.06), Vec3(0, 1, 0));
  const auto corner = hit_plate(Vec3(-7, -7, 0), Vec3(1, 1, 0));

  EXPECT_NEAR(rim->t, 7.0 - 0.08, 1e-15 * 7.0);  // 0.06² + 0.08² = 0.1²
  EXPECT_EQ(rim->core.feature.kind, FeatureKind::edge);
  EXPECT_NEAR((rim->normal - Vec3(0, -0.8, 0.6)).norm(), 0.0, 1e-13);
  EXPECT_NEAR(corner->t, 7.0 - 0.1 / std::sqrt(2.0), 1e-14);
  EXPECT_EQ(corner->core.feature, Feature(NodeId{0}));
}

TEST_F(RayOnAPlateAndABar, HitsTheSideAndTheEndOfACapsule) {
  const auto side = hit_bar(Vec3(1, -3, 9.06), Vec3(0, 1, 0));
  const auto end = hit_bar(Vec3(-3, 0, 9), Vec3(1, 0, 0));

  EXPECT_NEAR(side->t, 3.0 - 0.08, 1e-14);
  EXPECT_DOUBLE_EQ(end->t, 2.9);
  EXPECT_EQ(end->core.feature, Feature(NodeId{3}));
}

TEST_F(RayOnAPlateAndABar, MissesBesideBehindAndBeyondItsEnd) {
  EXPECT_FALSE(hit_plate(Vec3(-1, 1, 0.2), Vec3(1, 0, 0)).has_value());
  EXPECT_FALSE(hit_plate(Vec3(1, 1, 5), Vec3(0, 0, 1)).has_value());
  EXPECT_FALSE(hit({Vec3(1, 1, 5), Vec3(0, 0, -1), 4.0}, {surface_, complex_.x}, CellId{0}));
  EXPECT_FALSE(hit_plate(Vec3(1, 1, 5), Vec3::Zero()).has_value());
  EXPECT_FALSE(hit_plate(Vec3(1, 1, NAN), Vec3::UnitX()).has_value());
}

TEST_F(RayOnAPlateAndABar, StartsInsideAtZero) {
  const auto found = hit_plate(Vec3(1, 1, 0.05), Vec3(1, 0, 0));

  EXPECT_EQ(found->t, 0.0);
  EXPECT_EQ(found->normal, Vec3(0, 0, 1));
}

TEST_F(RayOnAPlateAndABar, FindsGrazingRaysOnTheRightSide) {
  const auto inside = hit_bar(Vec3(1, -3, 9.1 - 1e-9), Vec3(0, 1, 0));

  ASSERT_TRUE(inside.has_value());
  EXPECT_NEAR(inside->t, 3.0 - std::sqrt(2.0 * 0.1 * 1e-9), 1e-9);
  EXPECT_FALSE(hit_bar(Vec3(1, -3, 9.1 + 1e-9), Vec3(0, 1, 0)).has_value());
}

/// Of all cells, one by one.
std::optional<RayHit> first_of_all(const Ray& ray, const PlacedSurface& on) {
  std::optional<RayHit> first;
  for (std::size_t c = 0; c < on.surface.cell_count(); ++c) {
    const auto found = hit(ray, on, id_at<CellId>(c));
    if (found && (!first || found->t < first->t)) first = found;
  }
  return first;
}

// Every hit is at the radius from the core, nothing before it is inside, and none is missed.
TEST(FirstHit, IsWhereTheRayEntersTheThickSurface) {
  test::Random random(1);
  for (const Complex& complex : {test::sheet(6), test::net(5), test::ball(3)}) {
    const Surface surface = complex.surface();
    const SurfaceQuery query(surface, complex.x);
    int hits = 0;
    for (int trial = 0; trial < 400; ++trial) {
      const Vec3 origin = random.in_cube(trial % 2 == 0 ? 8.0 : 80.0);
      const Vec3 target = complex.x[random.index(complex.x.size())] + random.in_cube(1.0);
      const Ray ray{origin, target - origin};
      const auto expected = first_of_all(ray, {surface, complex.x});

      const auto found = query.first_hit(ray);

      ASSERT_EQ(found.has_value(), expected.has_value());
      if (!found) continue;
      ++hits;
      EXPECT_EQ(found->t, expected->t);
      EXPECT_EQ(found->cell, expected->cell);
      const double gap = query.nearest(Probe::point(found->point))->proximity.gap;
      EXPECT_LE(std::abs(found->t > 0.0 ? gap : 0.0), 1e-13);
      const Vec3 before = ray.origin + (1.0 - 1e-6) * found->t * ray.direction;
      if (found->t > 0.0) {
        EXPECT_GT(query.nearest(Probe::point(before))->proximity.gap, 0.0);
      }
    }
    EXPECT_GT(hits, 50);
  }
}

TEST(FirstHit, AgreesWithTheHitsOfTheCellsFromAnyDistance) {
  test::Random random(7);
  for (const Complex& complex : {test::sheet(6), test::net(5), test::ball(3)}) {
    const Surface surface = complex.surface();
    const SurfaceQuery query(surface, complex.x);
    for (const double far : {1e3, 1e8, 1e15, 1e16, 1e17, 1e20, 1e40, 1e74}) {
      int hits = 0;
      for (int trial = 0; trial < 100; ++trial) {
        const Vec3 target = complex.x[random.index(complex.x.size())] + random.in_cube(1.0);
        const Vec3 origin = target + far * random.direction();
        const Ray to_it{origin, (target - origin) * (trial % 2 == 0 ? 1.0 : 1e-3)};
        const Ray beside_it{origin, target + far * random.direction() - origin};
        for (const Ray& ray : {to_it, beside_it, Ray{origin, to_it.direction, 0.5}}) {
          const auto expected = first_of_all(ray, {surface, complex.x});

          const auto found = query.first_hit(ray);

          ASSERT_EQ(found.has_value(), expected.has_value()) << far << " m, trial " << trial;
          if (!found) continue;
          ++hits;
          ASSERT_EQ(found->t, expected->t) << far << " m, trial " << trial;
          ASSERT_EQ(found->cell, expected->cell) << far << " m, trial " << trial;
        }
      }
      EXPECT_GT(hits, 10) << far;
    }
  }
}

TEST(FirstHit, AgreesWithTheHitsOfTheCellsAboutRaysThatCannotHit) {
  const Complex complex = test::sheet(2);
  const Surface surface = complex.surface();
  const SurfaceQuery query(surface, complex.x);
  const Vec3 above = complex.x[0] + 3.0 * Vec3::UnitZ(), down = -Vec3::UnitZ();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Ray& ray :
       {Ray{above, Vec3::Zero()}, Ray{above, 1e-160 * down}, Ray{above, 1e160 * down},
        Ray{above, down, nan}, Ray{above, down, -1.0}, Ray{above + 1e80 * Vec3::UnitZ(), down},
        Ray{above, nan * down}, Ray{nan * above, down}}) {
    EXPECT_FALSE(query.first_hit(ray).has_value());
    EXPECT_FALSE(first_of_all(ray, {surface, complex.x}).has_value());
  }
  EXPECT_TRUE(query.first_hit({above, down}).has_value());
}

TEST(Hit, IsNotMissedFarFromTheOrigin) {
  const std::vector<Cylinder> wire{{{NodeId{0}, NodeId{1}}, 0.1}};
  const Surface surface(wire, {}, 2);
  test::Random random(11);
  for (const double far : {0.0, 1e3, 1e5, 1e7}) {
    for (int trial = 0; trial < 5000; ++trial) {
      const Vec3 middle = far * random.direction();
      const Vec3 half = random.in_cube(1.0);
      const std::vector<Vec3> x{middle - half, middle + half};
      const Vec3 origin = middle + 3.0 * random.direction();
      const auto found = hit({origin, middle - origin}, {surface, x}, CellId{0});
      ASSERT_TRUE(found.has_value()) << far << " m, trial " << trial;
      ASSERT_LE(found->t, 1.0);
    }
  }
}

// The way to it over the length of the direction is more than a number holds.
TEST(Hit, IsNoneBeyondAllNumbers) {
  Complex bar;
  bar.cylinder(bar.node(Vec3(1e74, 1e-20, 0)), bar.node(Vec3(1e74, 1, 0)));
  bar.cylinders.back().radius = 0.0;
  const Surface surface = bar.surface();

  EXPECT_FALSE(hit({Vec3::Zero(), Vec3(0, 1e-150, 0)}, {surface, bar.x}, CellId{0}));
}

TEST(Hit, IsNoneOfARayThatEndsBeforeItBegins) {
  const std::vector<Cylinder> wire{{{NodeId{0}, NodeId{1}}, 0.1}};
  const Surface surface(wire, {}, 2);
  const std::vector<Vec3> x{Vec3(-1, 0, 0), Vec3(1, 0, 0)};
  EXPECT_TRUE(hit({Vec3::Zero(), Vec3::UnitZ(), 0.0}, {surface, x}, CellId{0}).has_value());
  EXPECT_FALSE(hit({Vec3::Zero(), Vec3::UnitZ(), -1.0}, {surface, x}, CellId{0}).has_value());
}

}  // namespace
}  // namespace plekton::geometry::ray_test
