// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/weld.hpp"

#include "geometry/mesh/disjoint_sets.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/seeded_random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

namespace plekton::geometry::weld_test {
namespace {

using test::repaired;
using ::testing::ElementsAre;

TEST(Weld, JoinsChainsOfPointsAndOnlyThose) {
  const std::vector<Vec3> points = {{0, 0, 0},    {2.9, 0, 0}, {1, 0, 0},
                                    {1.95, 0, 0}, {4.1, 0, 0}, {4.1, 1.0, 0}};

  const Weld weld = weld_near_points(points, 1.0);

  EXPECT_THAT(weld.representative, ElementsAre(0, 0, 0, 0, 4, 4));
  EXPECT_EQ(weld.merged, 4u);
  EXPECT_EQ(weld.largest_move, 2.9);
}

TEST(Weld, AgreesWithComparingAllPairs) {
  test::Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Vec3> points;
    for (int i = 0; i < 60; ++i) points.push_back(random.in_cube(1.0));
    const double distance = 0.05 + 0.01 * trial;

    DisjointSets sets(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if ((points[i] - points[j]).norm() <= distance) sets.unite(i, j);

    const Weld weld = weld_near_points(points, distance);

    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(weld.representative[i], sets.find(i));
  }
}

TEST(Weld, JoinsPointsAtTheLeastDistanceThereIs) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();  // half of it is 0

  EXPECT_EQ(weld_near_points(std::vector<Vec3>{Vec3::Zero(), {kLeast, 0, 0}}, kLeast).merged, 1u);
}

// On borders of cells, which are rounded: 0.25 - 0.15 is a little less than 0.1.
TEST(Weld, JoinsPointsThatAreExactlyTheDistanceApart) {
  for (const auto& [a, b, distance] :
       {std::array{0.15, 0.25, 0.1}, std::array{10.235, 10.245, 0.01},
        std::array{20.47, 20.49, 0.02}, std::array{0.075, 0.125, 0.05}}) {
    ASSERT_LE(b - a, distance);
    const std::vector<Vec3> points{{a, 0, 0}, {b, 0, 0}, {0, 0, 0}};

    EXPECT_EQ(weld_near_points(points, distance).representative[1], 0u) << a;
  }
}

TEST(Weld, StaysQuickWhenTheDistanceIsLargerThanTheMesh) {
  const Mesh mesh = icosphere(1.0, 6);  // 40962 points: comparing all pairs would take seconds.

  EXPECT_EQ(weld_near_points(mesh.points, 10.0).merged, mesh.points.size() - 1);
}

TEST(Weld, RefusesADistanceBelowTheResolution) {
  const PolygonSoup soup = to_soup(box_shell({1e6, 1.0, 1.0}));

  EXPECT_THROW(repaired(soup, {.weld_distance = 1e-9}), MeshError);
  EXPECT_THROW(repaired(soup, {.weld_distance = -1.0}), MeshError);
  EXPECT_THROW(repaired(soup, {.weld_distance = std::numeric_limits<double>::quiet_NaN()}),
               MeshError);
}

}  // namespace
}  // namespace plekton::geometry::weld_test
