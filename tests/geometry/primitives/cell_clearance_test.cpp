// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/primitives/cell_clearance.hpp"

#include "geometry/base/predicates.hpp"
#include "geometry/critical/descent.hpp"
#include "tests/support/complexes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plekton::test::cell_clearance_test {
namespace {

/// A facet and a free cylinder with random corners: usual, far from the origin, or a sliver.
Complex facet_and_cylinder(Random& random) {
  Complex result;
  const Vec3 place = random.coin() ? Vec3::Zero().eval() : random.in_cube(1e3);
  for (int k = 0; k < 5; ++k) result.node(place + random.in_cube(1.0));
  if (random.coin()) {
    const double thin = std::pow(10.0, random.uniform(-12.0, 0.0));
    result.x[2] = result.x[0] + random.unit() * (result.x[1] - result.x[0]) + random.in_cube(thin);
  }
  result.facet(0, 1, 2);
  result.cylinder(3, 4);
  return result;
}

/// Anywhere near, or in the plane of the facet but for rounding and a little more.
Vec3 some_point(const Complex& complex, Random& random) {
  const auto& x = complex.x;
  if (random.coin()) return x[0] + random.in_cube(3.0);
  const Vec3 in_plane =
      x[0] + random.uniform(-2.0, 2.0) * (x[1] - x[0]) + random.uniform(-2.0, 2.0) * (x[2] - x[0]);
  return in_plane + random.in_cube(std::pow(10.0, random.uniform(-16.0, 0.0)));
}

bool is_inside(int k, const std::array<Vec3, 3>& x, const Vec3& point) {
  const auto corner = [&](int i) { return x[static_cast<std::size_t>((k + i) % 3)]; };
  return sign_inside_edge(corner(0), corner(1), corner(2), point) > 0;
}

TEST(FaceView, TellsThePlaceOfTheFootAsTheExactSignsDo) {
  Random random(1);
  int certain = 0;
  constexpr int kTrials = 100000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Complex complex = facet_and_cylinder(random);
    const Vec3 point = some_point(complex, random);
    const std::array<Vec3, 3> x{complex.x[0], complex.x[1], complex.x[2]};

    const FootPlace place = FaceView(point, x).place();

    const bool inside = is_inside(0, x, point) && is_inside(1, x, point) && is_inside(2, x, point);
    if (place == FootPlace::uncertain) continue;
    ++certain;
    ASSERT_EQ(place == FootPlace::inside, inside) << "trial " << trial;
  }
  EXPECT_GT(certain, kTrials / 2);
}

TEST(Clearance, IsNeverLargerThanTheDistanceAllows) {
  Random random(2);
  int positive = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    const Complex complex = facet_and_cylinder(random);
    const Surface surface = complex.surface();
    const Vec3 point = some_point(complex, random);
    const double range = random.uniform(0.0, 2.0);
    for (const CellId cell : {CellId{0}, CellId{1}}) {
      const double bound = clearance(surface, cell, point, range, complex.x);

      if (bound <= 0.0) continue;
      ++positive;
      const Feature nearest = closest_feature(surface, surface.feature_of(cell), point, complex.x);
      const double distance = foot_on(surface, nearest, point, complex.x).distance;
      // Both sides are rounded, by some eps of the distance between the point and a corner.
      constexpr double kRounding = 1e-14;
      ASSERT_LE(bound, distance - range + kRounding) << "trial " << trial;
    }
  }
  EXPECT_GT(positive, 10000);
}

TEST(Clearance, IsTheDistanceWhereTheFootLiesInTheFaceOrAcrossOneSide) {
  Complex complex;
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) complex.node(x);
  complex.facet(0, 1, 2);
  const Surface surface = complex.surface();
  const auto bound = [&](const Vec3& point) {
    return clearance(surface, CellId{0}, point, 0.5, complex.x);
  };

  // The bound is lower by its own room for rounding, 1e-12 of squared lengths.
  EXPECT_NEAR(bound(Vec3(0.2, 0.3, 2.0)), 1.5, 1e-10);
  EXPECT_NEAR(bound(Vec3(0.5, -3.0, 4.0)), 4.5, 1e-10);
  EXPECT_LE(bound(Vec3(0.2, 0.3, 0.4)), 0.0);
}

TEST(Clearance, ClaimsNothingOfAFacetWithoutAreaOrOfSizesWhoseSquaresVanish) {
  Complex complex;
  for (int k = 0; k < 3; ++k) complex.node(Vec3::Zero());
  complex.facet(0, 1, 2);
  const Surface surface = complex.surface();

  EXPECT_LE(clearance(surface, CellId{0}, Vec3(1, 0, 0), 0.5, complex.x), 0.0);

  complex.x[1] = Vec3(1e-80, 0, 0);
  complex.x[2] = Vec3(0, 1e-80, 0);
  EXPECT_LE(clearance(surface, CellId{0}, Vec3(1e-79, 0, 0), 1e-81, complex.x), 0.0);
}

}  // namespace
}  // namespace plekton::test::cell_clearance_test
