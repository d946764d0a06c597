// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/base/curvature.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace plekton::contact::curvature_test {
namespace {

using test::Random;

Body body(Shape shape, double radius) {
  return {.material = {1e9, 0.3, 0.5, 0.3}, .radius = radius, .shape = shape};
}

RelativeRadii radii(Shape a, double radius_a, Shape b, double radius_b) {
  return relative_radii(body(a, radius_a), body(b, radius_b));
}

void expect_radii(const RelativeRadii& got, double larger, double smaller) {
  EXPECT_DOUBLE_EQ(got.larger, larger);
  EXPECT_DOUBLE_EQ(got.smaller, smaller);
}

/// Johnson (1985), 4.1, by the curvatures of the surfaces.
TEST(Curvature, OfPairsWithASphereIsThatOfTheirSurfaces) {
  expect_radii(radii(Shape::sphere, 0.02, Shape::sphere, 0.03), 0.012, 0.012);
  expect_radii(radii(Shape::sphere, 0.02, Shape::flat, 1e-9), 0.02, 0.02);
  expect_radii(radii(Shape::sphere, 0.02, Shape::cylinder, 0.03), 0.02, 0.012);
}

TEST(Curvature, OfStructuresOnStructuresIsThatOfCrossedCylindersAndOfRoundEnds) {
  expect_radii(radii(Shape::cylinder, 0.02, Shape::cylinder, 0.03), 0.03, 0.02);
  expect_radii(radii(Shape::cylinder, 0.02, Shape::flat, 0.5), 0.02, 0.02);
  expect_radii(radii(Shape::flat, 0.02, Shape::flat, 0.005), 0.02, 0.005);
  EXPECT_DOUBLE_EQ(radii(Shape::flat, 0.02, Shape::flat, 0.005).equivalent(), 0.01);
}

TEST(Curvature, DoesNotDependOnTheOrderOfTheBodies) {
  constexpr std::array kShapes{Shape::sphere, Shape::cylinder, Shape::flat};
  Random random(1);
  for (const Shape a : kShapes) {
    for (const Shape b : kShapes) {
      const double radius_a = random.uniform(0.001, 0.1);
      const double radius_b = random.uniform(0.001, 0.1);
      const RelativeRadii ab = radii(a, radius_a, b, radius_b);
      const RelativeRadii ba = radii(b, radius_b, a, radius_a);
      EXPECT_EQ(ab.larger, ba.larger);
      EXPECT_EQ(ab.smaller, ba.smaller);
      EXPECT_GE(ab.larger, ab.smaller);
      EXPECT_EQ(hertz_radius(ab), hertz_radius(ba));
    }
  }
}

/// Harris, Rolling Bearing Analysis (1966), table of the approach of bodies in elliptical contact:
/// with the curvature sum S = 1/R' + 1/R'' and F = (1/R'' - 1/R') / S,
/// approach = delta* (3 P / (2 S E*))^(2/3) S / 2, which is that of a sphere of radius
/// 2 / (S delta*^3) on a plane. Its digits: half a unit of the fourth place of delta*.
TEST(HertzRadius, HasTheApproachOfTheTablesOfRollingBearings) {
  constexpr std::array<std::pair<double, double>, 12> kTable{{{0.1075, 0.9974},
                                                              {0.3204, 0.9761},
                                                              {0.4795, 0.9429},
                                                              {0.5916, 0.9077},
                                                              {0.6716, 0.8733},
                                                              {0.7332, 0.8394},
                                                              {0.7948, 0.7961},
                                                              {0.83495, 0.7602},
                                                              {0.87366, 0.7169},
                                                              {0.90999, 0.6636},
                                                              {0.95738, 0.5551},
                                                              {0.990902, 0.3745}}};
  for (const auto& [difference, approach] : kTable) {
    const RelativeRadii radii{1.0 / (1.0 - difference), 1.0 / (1.0 + difference)};  // S = 2

    // The fourth place of F moves delta* by its slope, at most 10 at the end of the table.
    EXPECT_NEAR(std::cbrt(1.0 / hertz_radius(radii)), approach, 3.5e-4) << difference;
  }
}

/// Hertz' equations hold for the axes that the standard library's integrals give (Johnson 4.24 to
/// 4.28), whatever the ratio of the radii.
TEST(HertzRadius, SolvesHertzEquations) {
  for (const double q : {0.999, 0.9, 0.7, 0.5, 0.2, 0.05, 1e-2, 1e-3}) {
    const double e = std::sqrt((1.0 - q) * (1.0 + q));
    const double first = std::comp_ellint_1(e);
    const double second = std::comp_ellint_2(e);
    const double larger = (second / (q * q) - first) / (first - second);  // R'' = 1
    // a³ = 3 P R' (K - E) / (pi E* e²) and d = 3 P K / (2 pi E* a): P² / d³ = 16/9 E*² R.
    const double expected = std::numbers::pi * std::numbers::pi * larger * (first - second) /
                            (2.0 * first * first * first * e * e);

    // K - E loses 1 / e² of its digits; and e is rounded, by which 1 - e² = q² is off by eps / q².
    const double eps = std::numeric_limits<double>::epsilon();
    EXPECT_NEAR(hertz_radius({larger, 1.0}) / expected, 1.0, 50.0 * eps / (e * e) + eps / (q * q))
        << q;
  }
}

TEST(HertzRadius, IsThatOfASphereWhereTheRadiiAreEqualAndGoesThereSteadily) {
  EXPECT_EQ(hertz_radius({0.3, 0.3}), 0.3);
  double before = 0.3;
  for (double more = 1e-16; more < 1e8; more *= 1.7) {
    const RelativeRadii radii{0.3 * (1.0 + more), 0.3};
    const double radius = hertz_radius(radii);
    // Between the radii, and it grows with R': by some roundings at least.
    ASSERT_GE(radius, before * (1.0 - 1e-14)) << more;
    ASSERT_LE(radius, radii.larger);
    // R = sqrt(R' R'') to first order.
    if (more < 1e-7) {
      ASSERT_NEAR(radius / radii.equivalent(), 1.0, 1e-14);
    }
    before = radius;
  }
}

}  // namespace
}  // namespace plekton::contact::curvature_test
