// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/exact_signs.hpp"

#include "tests/support/exact.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace plekton::geometry::exact_signs_test {
namespace {

/// Twice the area of a triangle as a vector, in integers of any length.
test::IntegerVec exact_area(const std::array<Vec3, 3>& x) {
  const auto s = test::scaled(x);
  return test::cross(test::difference(s.points[1], s.points[0]),
                     test::difference(s.points[2], s.points[0]));
}

/// Three points on a line, of small integers or but for the rounding of the last, which may be
/// moved by one unit in the last place besides.
std::array<Vec3, 3> nearly_collinear(test::Random& random) {
  if (random.integer(0, 3) == 0) {
    const Vec3 from = random.on_lattice(-5, 5);
    const Vec3 step = random.on_lattice(-2, 2);
    return {from, from + random.integer(-3, 3) * step, from + random.integer(-3, 3) * step};
  }
  const Vec3 from = random.in_cube(1.0);
  const Vec3 step = random.signed_power(-8.0, 8.0) * random.direction();
  std::array<Vec3, 3> x{from, from + step, from + random.uniform(-2.0, 3.0) * step};
  double& moved = x[random.index(3)][random.integer(0, 2)];
  if (random.coin()) moved = std::nextafter(moved, random.signed_power(100.0, 100.0));
  return x;
}

TEST(Turn, IsToTheLeftWhereTheNextAxesFollowEachOther) {
  // Along x one sees (y, z), along y (z, x), along z (x, y).
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 right = Vec3::Unit((axis + 1) % 3), up = Vec3::Unit((axis + 2) % 3);
    const Vec3 deep = 1e9 * Vec3::Unit(axis);

    EXPECT_EQ(turn(Axis{axis}, deep, right, up), 1) << axis;
    EXPECT_EQ(turn(Axis{axis}, deep, up, right), -1) << axis;
    EXPECT_EQ(turn(Axis{axis}, right, right + deep, right - deep), 0) << axis;
  }
}

TEST(Turn, IsThatOfIntegersOfAnyLength) {
  test::Random random(1);
  int zeros = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const auto x = nearly_collinear(random);
    const test::IntegerVec area = exact_area(x);
    for (int axis = 0; axis < 3; ++axis) {
      const int expected = area[static_cast<std::size_t>(axis)].sign();
      ASSERT_EQ(turn(Axis{axis}, x[0], x[1], x[2]), expected) << trial;
      zeros += expected == 0;
    }
  }
  EXPECT_GT(zeros, 1000);
}

TEST(AreCollinear, IsThatOfIntegersOfAnyLengthInAnyOrder) {
  test::Random random(2);
  std::array<int, 2> counts{};
  for (int trial = 0; trial < 20000; ++trial) {
    const auto [a, b, c] = nearly_collinear(random);
    const test::IntegerVec area = exact_area({a, b, c});
    const bool expected = area[0] == 0 && area[1] == 0 && area[2] == 0;
    ASSERT_EQ(are_collinear(a, b, c), expected) << trial;
    ASSERT_EQ(are_collinear(c, a, b), expected) << trial;
    ASSERT_EQ(are_collinear(b, a, c), expected) << trial;
    ++counts[expected ? 1 : 0];
  }
  EXPECT_GT(counts[0], 1000);
  EXPECT_GT(counts[1], 1000);
}

}  // namespace
}  // namespace plekton::geometry::exact_signs_test
