// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/geometry_check/check.hpp"

#include "tests/geometry_check/any_surface.hpp"
#include "tests/geometry_check/force_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

/// The check itself must be able to fail.
namespace plekton::geometry_check {
namespace {

using geometry::ClosestPoints;
using geometry::Core;
using geometry::Vec3;

ClosestPoints certified(const Core& a, const Core& b) {
  return geometry::closest_points(a, b);
}

std::uint64_t violations(std::uint64_t PairTally::*kind, const Report& report, const char* pair) {
  std::uint64_t sum = 0;
  for (const PairTally& row : report.pairs) sum += std::string(row.pair) == pair ? row.*kind : 0;
  return sum;
}

TEST(GeometryCheck, FindsNothingWrongWithTheKernel) {
  const Report report = check({20000, 1, 1, {}}, certified);

  EXPECT_EQ(report.violations(), 0U);
  EXPECT_TRUE(report.examples.empty());
  EXPECT_EQ(report.pairs.size(), 6U * 15U + 8U);
}

TEST(GeometryCheck, SeesTheSameOnAnyNumberOfThreads) {
  const Report one = check({20000, 2, 1, {}}, certified);
  const Report three = check({20000, 2, 3, {}}, certified);

  ASSERT_EQ(one.pairs.size(), three.pairs.size());
  for (std::size_t i = 0; i < one.pairs.size(); ++i) {
    EXPECT_EQ(one.pairs[i].queries, three.pairs[i].queries);
    EXPECT_EQ(one.pairs[i].largest_error, three.pairs[i].largest_error);
    EXPECT_EQ(one.pairs[i].double_doubles, three.pairs[i].double_doubles);
    EXPECT_EQ(one.pairs[i].exact, three.pairs[i].exact);
  }
}

TEST(GeometryCheck, CountsTheSignsOfEachStage) {
  PairTally sum{"", ""};
  for (const PairTally& row : check({20000, 3, 1, {}}, certified).pairs) {
    sum.double_doubles += row.double_doubles;
    sum.intervals += row.intervals;
    sum.exact += row.exact;
  }

  EXPECT_GT(sum.double_doubles, 0U);
  EXPECT_GT(sum.intervals, 0U);
  EXPECT_GE(sum.intervals, sum.exact);
}

/// The region of a point and a triangle by the signs of barycentric coordinates in double, as it is
/// commonly done.
ClosestPoints by_barycentric_coordinates(const Core& a, const Core& b) {
  if (a.count != 1 || b.count != 3) return certified(a, b);
  const Vec3 u = b.x[1] - b.x[0], v = b.x[2] - b.x[0], w = a.x[0] - b.x[0];
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), wu = w.dot(u), wv = w.dot(v);
  const double area = uu * vv - uv * uv;
  const double s = (vv * wu - uv * wv) / area, t = (uu * wv - uv * wu) / area;
  if (!(s > 0.0 && t > 0.0 && s + t < 1.0)) return certified(a, b);
  ClosestPoints found = certified(a, b);
  found.corners_b = 7U;
  return found;
}

TEST(GeometryCheck, FindsRegionsThatAreDecidedInDouble) {
  const Report report = check({100000, 3, 1, {}}, by_barycentric_coordinates);

  EXPECT_GT(violations(&PairTally::wrong_regions, report, "sphere-facet"), 100U);
  EXPECT_EQ(violations(&PairTally::wrong_regions, report, "facet-facet"), 0U);
  EXPECT_FALSE(report.examples.empty());
}

TEST(GeometryCheck, FindsDistancesThatAreOffByATrillionth) {
  const Report report = check({20000, 4, 1, {}}, [](const Core& a, const Core& b) {
    ClosestPoints found = certified(a, b);
    found.distance *= 1.0 + 2e-12;
    return found;
  });

  EXPECT_GT(violations(&PairTally::wrong_distances, report, "cylinder-cylinder"), 1000U);
}

TEST(GeometryCheck, FindsAnswersThatDependOnTheOrderOfTheBodies) {
  const Report report = check({20000, 5, 1, {}}, [](const Core& a, const Core& b) {
    ClosestPoints found = certified(a, b);
    if (a.x[0].x() < b.x[0].x()) found.distance = std::nextafter(found.distance, 1e300);
    return found;
  });

  EXPECT_GT(violations(&PairTally::one_sided, report, "cylinder-facet"), 1000U);
}

TEST(GeometryCheck, FindsCrossingsThatAreReportedAsApartAndNumbersThatAreNone) {
  const Report report = check({20000, 6, 1, {}}, [](const Core& a, const Core& b) {
    ClosestPoints found = certified(a, b);
    if (found.relation == geometry::Relation::touching_or_crossing) {
      found.relation = geometry::Relation::apart;
      found.separation.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    return found;
  });

  EXPECT_GT(violations(&PairTally::wrong_relations, report, "facet-facet"), 100U);
  EXPECT_GT(violations(&PairTally::not_numbers, report, "facet-facet"), 100U);
}

/// One contact for each minimum of the distance, without the passes between them.
std::optional<Vec3> force_of_minima(const Touch& touch) {
  const auto cells = test::cells_near(touch.surface, touch.centre, touch.range, touch.x);
  geometry::CriticalFeatureFinder finder(touch.surface);
  Vec3 force = Vec3::Zero();
  for (const auto& feature : finder.find(touch.centre, touch.range, cells, touch.x)) {
    if (feature.is_minimum()) force -= (touch.range - feature.distance) * feature.direction;
  }
  return force;
}

TEST(GeometryCheck, FindsForcesThatJumpOverCreases) {
  test::Random random(8);
  ForceTally of_minima, of_patches;
  for (int surface = 0; surface < 400; ++surface) {
    const test::Complex complex =
        test::roughened(test::sheet(3), 1.0, random.signed_power(-9.0, -6.0), random);
    test::Random same = random;
    const ForceTally minima = check_force(complex, force_of_minima, random, 50);
    const ForceTally patches = check_force(complex, force_of_patches, same, 50);
    of_minima.violations += minima.violations;
    of_patches.violations += patches.violations;
    of_patches.trials += patches.trials;
  }

  EXPECT_GT(of_minima.violations, 10);
  EXPECT_EQ(of_patches.violations, 0);
  EXPECT_GT(of_patches.trials, 1000);
}

}  // namespace
}  // namespace plekton::geometry_check
