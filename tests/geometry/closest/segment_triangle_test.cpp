// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/segment_triangle.hpp"

#include "tests/support/closest_checks.hpp"

namespace plekton::geometry::segment_triangle_test {
namespace {

TEST(SegmentTriangle, AgreesWithExactRationalsOnAdversarialFamilies) {
  test::expect_exact_on_all_families<2, 3>(segment_triangle, 1, 100000);
}

TEST(SegmentTriangle, StopsOnTheLowestFeatureOfATie) {
  test::expect_the_lowest_of_ties<2, 3>(segment_triangle, 2, 1000);
}

TEST(SegmentTriangle, IsNeverNotANumberAtAnyScale) {
  test::expect_numbers_at_any_scale<2, 3>(segment_triangle, 3, 300);
}

TEST(SegmentTriangle, FindsWhereASegmentGoesThroughAFace) {
  const ClosestPoints found = segment_triangle({Vec3(1, 1, -1), Vec3(1, 1, 3)},
                                               {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)});

  EXPECT_EQ(found.relation, Relation::touching_or_crossing);
  EXPECT_EQ(found.distance, 0.0);
  EXPECT_EQ(found.corners_a, 3U);
  EXPECT_EQ(found.corners_b, 7U);
  EXPECT_EQ(found.weights_a, Vec3(0.75, 0.25, 0.0));
  EXPECT_EQ(found.weights_b, Vec3(0.5, 0.25, 0.25));
}

TEST(SegmentTriangle, StopsOnAnEndOfASegmentParallelToTheFace) {
  const ClosestPoints found = segment_triangle({Vec3(1, 1, 2), Vec3(2, 1, 2)},
                                               {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)});

  EXPECT_EQ(found.corners_a, 1U);
  EXPECT_EQ(found.corners_b, 7U);
  EXPECT_EQ(found.separation, Vec3(0, 0, -2));
}
}  // namespace
}  // namespace plekton::geometry::segment_triangle_test
