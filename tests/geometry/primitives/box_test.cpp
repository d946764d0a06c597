// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/primitives/box.hpp"

#include "tests/support/exact.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace plekton::geometry::box_test {
namespace {

/// Sign of point + margin - bound, without rounding.
int exact_excess(double point, double margin, double bound) {
  const auto s = test::scaled(std::array{Vec3(point, margin, bound)});
  return test::Integer(s.points[0][0] + s.points[0][1] - s.points[0][2]).sign();
}

TEST(Box, HoldsTheMinkowskiSumInExactArithmetic) {
  test::Random random(1);
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<Vec3> points(1 + random.index(3));
    for (Vec3& x : points)
      x = Vec3(random.signed_power(-20, 6), random.signed_power(-20, 6),
               random.signed_power(-20, 6));
    const double margin = random.integer(0, 9) == 0 ? 0.0 : std::abs(random.signed_power(-20, 3));

    const Box box = bounding_box(points, margin);

    for (const Vec3& x : points) {
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(exact_excess(x[axis], margin, box.upper[axis]), 0);
        EXPECT_LE(exact_excess(-x[axis], margin, -box.lower[axis]), 0);
      }
    }
  }
}

TEST(Box, IsNoLargerThanTwoUnitsInTheLastPlace) {
  test::Random random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    const std::array<Vec3, 3> points{random.in_cube(5.0), random.in_cube(5.0), random.in_cube(5.0)};
    const double margin = random.uniform(0.0, 1.0);

    const Box box = bounding_box(points, margin);

    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax({points[0][axis], points[1][axis], points[2][axis]});
      const double ulp = 0x1p-52 * 8.0;  // of a number below 8
      EXPECT_GE(box.lower[axis], low - margin - 2.0 * ulp);
      EXPECT_LE(box.upper[axis], high + margin + 2.0 * ulp);
    }
  }
}

TEST(Box, OfOnePointWithoutMarginHoldsThePointInside) {
  const std::array<Vec3, 1> point{Vec3(1.0, 0.0, -2.0)};

  const Box box = bounding_box(point, 0.0);

  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LT(box.lower[axis], point[0][axis]);
    EXPECT_GT(box.upper[axis], point[0][axis]);
  }
}

}  // namespace
}  // namespace plekton::geometry::box_test
