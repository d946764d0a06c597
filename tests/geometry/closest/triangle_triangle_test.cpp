// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/triangle_triangle.hpp"

#include "tests/support/closest_checks.hpp"

namespace plekton::geometry::triangle_triangle_test {
namespace {

TEST(TriangleTriangle, AgreesWithExactRationalsOnAdversarialFamilies) {
  test::expect_exact_on_all_families<3, 3>(triangle_triangle, 1, 100000);
}

TEST(TriangleTriangle, StopsOnTheLowestFeatureOfATie) {
  test::expect_the_lowest_of_ties<3, 3>(triangle_triangle, 2, 1000);
}

TEST(TriangleTriangle, IsNeverNotANumberAtAnyScale) {
  test::expect_numbers_at_any_scale<3, 3>(triangle_triangle, 3, 300);
}

TEST(TriangleTriangle, IsTheSameFromBothSides) {
  test::expect_the_same_from_both_sides<3, 3>(triangle_triangle, triangle_triangle, 4, 5000);
}

TEST(TriangleTriangle, ReportsCoplanarTrianglesThatOverlapAsStructurePair) {
  const std::array<Vec3, 3> a{Vec3(0, 0, 1), Vec3(4, 0, 1), Vec3(0, 4, 1)};
  const std::array<Vec3, 3> star{Vec3(1, -1, 1), Vec3(3, 3, 1), Vec3(-1, 1, 1)};

  const ClosestPoints found = triangle_triangle(a, star);

  EXPECT_EQ(found.relation, Relation::touching_or_crossing);
  EXPECT_EQ(found.distance, 0.0);
  EXPECT_EQ(triangle_triangle(a, a).relation, Relation::touching_or_crossing);
}

TEST(TriangleTriangle, KeepsTheDistanceOfParallelFacesWhateverTheirTilt) {
  const std::array<Vec3, 3> a{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  for (const double tilt : {0.0, 1e-16, 1e-12, 1e-9, -1e-9}) {
    const ClosestPoints found =
        triangle_triangle(a, {Vec3(1, 1, 0.5), Vec3(2, 1, 0.5 + tilt), Vec3(1, 2, 0.5)});

    EXPECT_NEAR(found.distance, 0.5, std::abs(tilt) + 1e-15);
  }
}
}  // namespace
}  // namespace plekton::geometry::triangle_triangle_test
