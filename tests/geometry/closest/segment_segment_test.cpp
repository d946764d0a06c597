// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/segment_segment.hpp"

#include "tests/support/closest_checks.hpp"

namespace plekton::geometry::segment_segment_test {
namespace {

TEST(SegmentSegment, AgreesWithExactRationalsOnAdversarialFamilies) {
  test::expect_exact_on_all_families<2, 2>(segment_segment, 1, 100000);
}

TEST(SegmentSegment, StopsOnTheLowestFeatureOfATie) {
  test::expect_the_lowest_of_ties<2, 2>(segment_segment, 2, 1000);
}

TEST(SegmentSegment, IsNeverNotANumberAtAnyScale) {
  test::expect_numbers_at_any_scale<2, 2>(segment_segment, 3, 300);
}

TEST(SegmentSegment, IsTheSameFromBothSides) {
  test::expect_the_same_from_both_sides<2, 2>(segment_segment, segment_segment, 4, 5000);
}

TEST(SegmentSegment, FindsTheCommonPerpendicularOfCrossedCylinders) {
  const ClosestPoints found =
      segment_segment({Vec3(-1, 0, 0), Vec3(3, 0, 0)}, {Vec3(0, -1, 2), Vec3(0, 1, 2)});

  EXPECT_EQ(found.corners_a, 3U);
  EXPECT_EQ(found.corners_b, 3U);
  EXPECT_EQ(found.weights_a, Vec3(0.75, 0.25, 0.0));
  EXPECT_EQ(found.weights_b, Vec3(0.5, 0.5, 0.0));
  EXPECT_EQ(found.separation, Vec3(0, 0, 2));
  EXPECT_EQ(found.distance, 2.0);
}

TEST(SegmentSegment, ReportsSegmentsThatCrossInAPlaneAsStructurePair) {
  const ClosestPoints found =
      segment_segment({Vec3(-1, 0, 5), Vec3(1, 0, 5)}, {Vec3(0, -1, 5), Vec3(0, 3, 5)});

  EXPECT_EQ(found.relation, Relation::touching_or_crossing);
  EXPECT_EQ(found.distance, 0.0);
  EXPECT_EQ(found.weights_a, Vec3(0.5, 0.5, 0.0));
  EXPECT_EQ(found.weights_b, Vec3(0.75, 0.25, 0.0));
}

TEST(ClosestCounters, CountPairsTiesAndExactLengths) {
  closest_counters() = {};

  segment_segment({Vec3(0, 0, 0), Vec3(1, 0, 0)}, {Vec3(0.3, -1, 1), Vec3(0.4, 1, 1)});
  EXPECT_EQ(closest_counters().pairs, 1U);
  EXPECT_EQ(closest_counters().enumerated, 0U);
  segment_segment({Vec3(0, 0, 0), Vec3(1, 0, 0)}, {Vec3(0, 1, 0), Vec3(1, 1, 0)});  // parallel
  EXPECT_EQ(closest_counters().enumerated, 1U);
  EXPECT_EQ(closest_counters().exact_lengths, 0U);
  segment_segment({Vec3(0, 0, 0), Vec3(1, 0, 0)}, {Vec3(0.3, -1, 1e-9), Vec3(0.4, 1, 1e-9)});
  EXPECT_EQ(closest_counters().exact_lengths, 1U);
}
}  // namespace
}  // namespace plekton::geometry::segment_segment_test
