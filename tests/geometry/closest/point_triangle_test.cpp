// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/point_triangle.hpp"

#include "tests/support/closest_checks.hpp"

namespace plekton::geometry::point_triangle_test {
namespace {

ClosestPoints kernel(const std::array<Vec3, 1>& a, const std::array<Vec3, 3>& b) {
  return point_triangle(a[0], b);
}

TEST(ClosestPointTriangle, AgreesWithExactRationalsOnAdversarialFamilies) {
  test::expect_exact_on_all_families<1, 3>(kernel, 1, 100000);
}

TEST(ClosestPointTriangle, StopsOnTheLowestFeatureOfATie) {
  test::expect_the_lowest_of_ties<1, 3>(kernel, 2, 3000);
}

TEST(ClosestPointTriangle, IsNeverNotANumberAtAnyScale) {
  test::expect_numbers_at_any_scale<1, 3>(kernel, 3, 300);
}

}  // namespace
}  // namespace plekton::geometry::point_triangle_test
