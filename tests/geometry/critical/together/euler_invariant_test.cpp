// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/critical/critical_features.hpp"
#include "tests/support/complexes.hpp"

#include <gtest/gtest.h>

// The coefficients of all features of a surface add up to its Euler characteristic, for every
// point: the self-test of the signs. More than a million points in all: 300 000 closed, 200 000
// open, 500 000 non-manifold.
namespace plekton::geometry::euler_invariant_test {
namespace {

using test::Complex;

/// Points of a number at which the sum is not the Euler characteristic.
int violations(const Complex& complex, test::Random& random, int points) {
  const Surface surface = complex.surface();
  const auto features = test::features_of(surface);
  CriticalFeatureFinder finder(surface);
  int count = 0;
  for (int k = 0; k < points; ++k) {
    const Vec3 point = test::random_point(random, complex);
    int sum = 0;
    for (const Feature feature : features)
      sum += finder.link(feature, point, complex.x).coefficient;
    count += sum != surface.euler_characteristic();
  }
  return count;
}

/// The same for the surface as it is and rotated at random, half of the points each.
int violations_also_rotated(const Complex& complex, test::Random& random, int points) {
  constexpr int kRotations = 10;
  int count = violations(complex, random, points / 2);
  for (int k = 0; k < kRotations; ++k) {
    count += violations(test::rotated(complex, random.rotation()), random, points / 2 / kRotations);
  }
  return count;
}

TEST(EulerInvariant, HoldsOnClosedSurfaces) {
  test::Random random(1);

  EXPECT_EQ(violations_also_rotated(test::cube(4), random, 80000), 0);
  EXPECT_EQ(violations_also_rotated(test::cube(1), random, 100000), 0);
  EXPECT_EQ(violations_also_rotated(test::ball(0), random, 80000), 0);
  EXPECT_EQ(violations_also_rotated(test::ball(2), random, 40000), 0);
}

TEST(EulerInvariant, HoldsOnOpenSurfaces) {
  test::Random random(2);

  EXPECT_EQ(violations_also_rotated(test::sheet(3), random, 100000), 0);
  EXPECT_EQ(violations_also_rotated(test::net(3), random, 60000), 0);
  EXPECT_EQ(violations_also_rotated(test::book({20, -70}), random, 40000), 0);
}

TEST(EulerInvariant, HoldsOnFinsAndBowTies) {
  test::Random random(3);

  EXPECT_EQ(violations_also_rotated(test::book({0, 90, 180}), random, 50000), 0);
  EXPECT_EQ(violations_also_rotated(test::book({10, 50, 110, 200, 280}), random, 50000), 0);
  EXPECT_EQ(violations_also_rotated(test::bow_tie(), random, 50000), 0);
}

TEST(EulerInvariant, HoldsOnRandomComplexesOfFacetsAndCylinders) {
  constexpr int kComplexes = 8000;
  test::Random random(4);
  int count = 0;

  for (int k = 0; k < kComplexes; ++k) {
    Complex complex = test::random_complex(random, k % 2 == 0);
    if (k % 4 < 2) complex = test::rotated(complex, random.rotation());
    count += violations(complex, random, 50);
  }

  EXPECT_EQ(count, 0);
}

}  // namespace
}  // namespace plekton::geometry::euler_invariant_test
