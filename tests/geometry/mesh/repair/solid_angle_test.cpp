// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/solid_angle.hpp"

#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace plekton::geometry::solid_angle_test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kEps = std::numeric_limits<double>::epsilon();

using Triangle = std::array<Vec3, 3>;

double solid_angle_of(const Mesh& mesh, const Vec3& point) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.facets)
    sum += solid_angle(
        {mesh.points[index_of(a)], mesh.points[index_of(b)], mesh.points[index_of(c)]}, point);
  return sum;
}

TEST(SolidAngle, IsAnEighthOfTheSphereForAnOctantWithTheSignOfTheSide) {
  const Triangle octant{Vec3(1, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 3)};

  EXPECT_NEAR(solid_angle(octant, Vec3::Zero()), 0.5 * kPi, 4.0 * kEps);
  EXPECT_NEAR(solid_angle({octant[1], octant[0], octant[2]}, Vec3::Zero()), -0.5 * kPi, 4.0 * kEps);
  EXPECT_LT(solid_angle(octant, Vec3(5, 5, 5)), 0.0) << "above it";
}

TEST(SolidAngle, OfARectangleOverItsMiddleIsThatOfTheFormula) {
  // 4 arcsin(p q / sqrt((1 + p^2)(1 + q^2))), with p and q half the sides over the distance.
  for (const auto& [p, q] : {std::array{0.5, 0.5}, std::array{3.0, 0.2}, std::array{40.0, 70.0}}) {
    const double distance = 0.3;
    const Vec3 a(-p, -q, 1), b(p, -q, 1), c(p, q, 1), d(-p, q, 1);
    const auto at = [&](const Vec3& x) { return Vec3(distance * x + Vec3(1.0, 2.0, -3.0)); };

    const double found = solid_angle({at(a), at(b), at(c)}, Vec3(1.0, 2.0, -3.0)) +
                         solid_angle({at(a), at(c), at(d)}, Vec3(1.0, 2.0, -3.0));

    const double expected = 4.0 * std::asin(p * q / std::sqrt((1.0 + p * p) * (1.0 + q * q)));
    // The rounding of corners at 3 m is seen from 0.3 m.
    EXPECT_NEAR(found, expected, 100.0 * kEps * (1.0 + p + q)) << p;
  }
}

TEST(SolidAngle, AddsUpToTheWholeSphereInsideAClosedSurfaceAndToNothingOutside) {
  const Mesh sphere = icosphere(1.0, 2);
  test::Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    // Facets of 20 degrees are at most 1.5 % of the radius below the sphere.
    const double radius = trial % 2 == 0 ? random.uniform(0.0, 0.95) : random.uniform(1.05, 9.0);
    const Vec3 point = radius * random.direction();

    // 320 facets, whose products of lengths of up to 10 m are off by some eps each.
    EXPECT_NEAR(solid_angle_of(sphere, point), radius < 1.0 ? 4.0 * kPi : 0.0, 320 * 1000.0 * kEps)
        << radius;
  }
}

TEST(SolidAngle, IsThatOfThePartsOfATriangle) {
  test::Random random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    const Triangle x{random.in_cube(1.0), random.in_cube(1.0), random.in_cube(1.0)};
    const Vec3 within = 0.3 * x[0] + 0.5 * x[1] + 0.2 * x[2];
    const Vec3 point = random.in_cube(1.0);

    double parts = 0.0;
    for (std::size_t k = 0; k < 3; ++k) parts += solid_angle({x[k], x[(k + 1) % 3], within}, point);

    // Near the plane the sign may round either way, by all of what is seen.
    const double apart = (point - x[0]).dot((x[1] - x[0]).cross(x[2] - x[0]).normalized());
    if (std::abs(apart) > 1e-3) {
      ASSERT_NEAR(parts, solid_angle(x, point), 1e-12) << trial;
    }
  }
}

TEST(SolidAngle, InThePlaneOfTheTriangleIsNothingOrHalfTheSphere) {
  const Triangle x{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

  EXPECT_EQ(std::abs(solid_angle(x, Vec3(1, 1, 0))), 2.0 * kPi);
  for (const Vec3& outside : {Vec3(3, 3, 0), Vec3(-1, 1, 0), Vec3(8, 0, 0)})
    EXPECT_EQ(solid_angle(x, outside), 0.0);
  // On both sides of it nearly half, of opposite signs.
  EXPECT_NEAR(solid_angle(x, Vec3(1, 1, -1e-9)), 2.0 * kPi, 1e-8);
  EXPECT_NEAR(solid_angle(x, Vec3(1, 1, 1e-9)), -2.0 * kPi, 1e-8);
}

}  // namespace
}  // namespace plekton::geometry::solid_angle_test
