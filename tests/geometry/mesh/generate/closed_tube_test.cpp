// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/closed_tube.hpp"

#include "geometry/mesh/repair/measures.hpp"
#include "geometry/mesh/repair/repair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace plekton::geometry::closed_tube_test {
namespace {

using std::numbers::pi;

/// A generated mesh needs no repair; equal after it.
MeshMeasures measures_of_clean(const Mesh& mesh) {
  MeshReport report;
  const Mesh same = repair(to_soup(mesh), {}, report);
  EXPECT_EQ(same.facets, mesh.facets);
  EXPECT_EQ(report.verdict, MeshVerdict::ok) << to_text(report);
  return report.after;
}

/// m³, between polygons of n corners, each turned by half a cell against the next: prismatoids,
/// whose section in the middle has 2 n corners.
double volume_of(const Tube& tube) {
  const double n = tube.around;
  const double end = 0.5 * n * std::sin(2.0 * pi / n);
  const double middle = n * std::pow(std::cos(0.5 * pi / n), 2) * std::sin(pi / n);
  return tube.length * tube.radius * tube.radius * (2.0 * end + 4.0 * middle) / 6.0;
}

TEST(ClosedTube, EnclosesTheVolumeOfItsPolygonsAndFacesOutward) {
  for (int around = 3; around <= 40; ++around) {
    for (const int along : {1, 4, 5}) {
      const Tube tube{0.5, 2.0, around, along};
      SCOPED_TRACE(testing::Message() << around << " cells around, " << along << " along");

      const Mesh mesh = closed_tube(tube, {true, true});
      const MeshMeasures m = measures_of_clean(mesh);

      EXPECT_EQ(m.euler_characteristic, 2);
      EXPECT_EQ(m.border_edges, 0U);
      EXPECT_EQ(m.inconsistent_edges, 0U);
      EXPECT_EQ(m.non_manifold_nodes, 0U);
      EXPECT_EQ(m.bounds_volume, true);  // and faces outward
      const double rounding = 4.0 * static_cast<double>(m.facets) * 2.2e-16;
      EXPECT_NEAR(m.volume.value(), volume_of(tube), rounding * volume_of(tube));
    }
  }
}

/// Of facets as fine as the tube's: no angle of an end is near 0, and no edge much longer or shorter
/// than the side of the polygon.
TEST(ClosedTube, HasEndsAsFineAsItsSides) {
  for (int around = 3; around <= 60; ++around) {
    const double side = 2.0 * std::sin(pi / around);
    const Mesh mesh = closed_tube({1.0, side, around, 1}, {true, true});

    const MeshMeasures m = measures_of_clean(mesh);

    EXPECT_GT(m.smallest_angle, 29.9) << around;  // 30 where three meet in the middle
    EXPECT_GT(m.shortest_edge, 0.5 * side) << around;
    EXPECT_LT(m.longest_edge, 2.0 * side) << around;
  }
}

TEST(ClosedTube, HasTheNodesOfTheTubeFirstAndDiscsOnlyWhereAsked) {
  const Tube open{0.5, 2.0, 12, 7};
  const Mesh plain = tube(open);

  EXPECT_EQ(closed_tube(open, {false, false}).facets, plain.facets);
  for (const bool upper : {false, true}) {
    const Mesh cup = closed_tube(open, {!upper, upper});

    const MeshMeasures m = measures_of_clean(cup);
    EXPECT_EQ(m.euler_characteristic, 1);
    EXPECT_EQ(m.border_edges, 12U);
    EXPECT_TRUE(std::equal(plain.points.begin(), plain.points.end(), cup.points.begin()));
    // A middle, and a ring of 6 around it.
    ASSERT_EQ(cup.points.size(), plain.points.size() + 7);
    for (std::size_t i = plain.points.size(); i < cup.points.size(); ++i)
      EXPECT_EQ(cup.points[i].z(), upper ? 2.0 : 0.0);
  }
}

TEST(ClosedTube, RefusesWhatMakesNoTubeAndMoreNodesThanNumbers) {
  EXPECT_THROW(closed_tube({1.0, 1.0, 2, 1}, {true, true}), MeshError);
  EXPECT_THROW(closed_tube({-1.0, 1.0, 6, 1}, {true, true}), MeshError);
  EXPECT_THROW(closed_tube({1.0, 1.0, 200'000, 1}, {true, true}), MeshError);  // 6.7e9 in the discs
}

}  // namespace
}  // namespace plekton::geometry::closed_tube_test
