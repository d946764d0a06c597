// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/point_segment.hpp"

#include "tests/support/closest_checks.hpp"

namespace plekton::geometry::point_segment_test {
namespace {

ClosestPoints kernel(const std::array<Vec3, 1>& a, const std::array<Vec3, 2>& b) {
  return point_segment(a[0], b);
}

TEST(ClosestPointSegment, AgreesWithExactRationalsOnAdversarialFamilies) {
  test::expect_exact_on_all_families<1, 2>(kernel, 1, 100000);
}

TEST(ClosestPointSegment, StopsOnTheLowestFeatureOfATie) {
  test::expect_the_lowest_of_ties<1, 2>(kernel, 2, 3000);
}

TEST(ClosestPointSegment, IsNeverNotANumberAtAnyScale) {
  test::expect_numbers_at_any_scale<1, 2>(kernel, 3, 300);
}

}  // namespace
}  // namespace plekton::geometry::point_segment_test
