// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/repair/repair.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/seeded_random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace plekton::geometry::repair_test {
namespace {

using test::repaired;
using test::shape;
using test::unshared;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Repair, LeavesACleanMeshAsItIs) {
  const Mesh mesh = icosphere(1.0, 2);

  const auto [result, report] = repaired(to_soup(mesh));

  EXPECT_EQ(result.points, mesh.points);
  EXPECT_EQ(result.facets, mesh.facets);
  EXPECT_EQ(report.verdict, MeshVerdict::ok);
  EXPECT_EQ(report.after.bounds_volume, true);
}

TEST(Repair, MergesTheUnsharedPointsOfAnStl) {
  const auto [result, report] = repaired(unshared(icosphere(1.0, 2)));

  EXPECT_EQ(report.found.points, 960u);
  EXPECT_EQ(report.changed.points_merged, 960u - 162u);
  EXPECT_EQ(shape(result), shape(icosphere(1.0, 2)));
  EXPECT_EQ(report.verdict, MeshVerdict::ok)
      << "merging equal points is what STL asks for, no repair";
}

TEST(Repair, MergesZeroAndMinusZero) {
  PolygonSoup soup{{{0.0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, -0.0, 0}, {1, 1, 0}},
                   {{0, 1, 2}, {3, 2, 4}, {1, 4, 2}}};

  EXPECT_EQ(repaired(soup).report.changed.points_merged, 1u);
}

TEST(Repair, LeavesNearlyEqualPointsApartUntilAskedToWeld) {
  PolygonSoup soup = unshared(box_shell({1.0, 1.0, 1.0}));
  test::Random random(3);
  for (Vec3& p : soup.points) p += random.in_cube(1e-7);

  const auto apart = repaired(soup).report;
  const auto welded = repaired(soup, {.weld_distance = 1e-6}).report;

  EXPECT_EQ(apart.after.components, 12u);
  EXPECT_EQ(apart.found.near_duplicate_points, 28u);
  EXPECT_THAT(apart.reasons, ::testing::Contains(HasSubstr("28 points lie within")));
  EXPECT_EQ(welded.changed.points_welded, 28u);
  EXPECT_LE(welded.changed.largest_weld_move, std::sqrt(3.0) * 2e-7);
  EXPECT_EQ(welded.after.points, 8u);
  EXPECT_EQ(welded.after.bounds_volume, true);
  EXPECT_EQ(welded.verdict, MeshVerdict::repaired);
}

template <class Item>
void shuffle(std::vector<Item>& items, test::Random& random) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.index(i)]);
}

TEST(Repair, DoesNotDependOnTheOrderOfPointsAndPolygons) {
  PolygonSoup soup = unshared(icosphere(1.0, 1));
  test::Random random(11);
  for (Vec3& p : soup.points) p += random.in_cube(1e-7);
  for (std::size_t f = 0; f < soup.polygons.size(); f += 7)
    std::swap(soup.polygons[f][0], soup.polygons[f][1]);
  const auto reference = repaired(soup, {.weld_distance = 1e-6});

  for (int trial = 0; trial < 20; ++trial) {
    std::vector<std::size_t> place(soup.points.size());
    for (std::size_t i = 0; i < place.size(); ++i) place[i] = i;
    shuffle(place, random);
    PolygonSoup shuffled = soup;
    for (std::size_t i = 0; i < place.size(); ++i) shuffled.points[place[i]] = soup.points[i];
    for (auto& polygon : shuffled.polygons) {
      for (std::size_t& corner : polygon) corner = place[corner];
      std::rotate(polygon.begin(), polygon.begin() + trial % 3, polygon.end());
    }
    shuffle(shuffled.polygons, random);

    const auto result = repaired(shuffled, {.weld_distance = 1e-6});

    EXPECT_EQ(shape(result.mesh), shape(reference.mesh));
    EXPECT_EQ(result.report.changed.flipped_facets, reference.report.changed.flipped_facets);
  }
}

TEST(Repair, DropsFacetsThatAreDegenerateOrThereTwiceAndCountsEachKind) {
  PolygonSoup soup = to_soup(box_shell({1.0, 1.0, 1.0}));
  soup.points.push_back({0.5, 0.0, 0.0});                   // 8, on an edge
  soup.points.push_back({9.0, 9.0, 9.0});                   // 9, used by nobody
  soup.polygons.push_back({0, 1, 1});                       // repeats a node
  soup.polygons.push_back({2, 3});                          // has two corners
  soup.polygons.push_back({soup.polygons[0][0], 8, 8, 8});  // repeats a node
  soup.polygons.push_back(soup.polygons[3]);                // is there twice
  soup.polygons.push_back(
      {soup.polygons[5].rbegin(), soup.polygons[5].rend()});  // twice, turned over
  std::size_t a = 0, b = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    if (soup.points[i] == Vec3(0, 0, 0)) a = i;
    if (soup.points[i] == Vec3(1, 0, 0)) b = i;
  }
  soup.polygons.push_back({a, 8, b});  // has no area

  const auto [mesh, report] = repaired(soup);

  EXPECT_EQ(report.changed.repeated_node_facets, 3u);
  EXPECT_EQ(report.changed.zero_area_facets, 1u);
  EXPECT_EQ(report.changed.duplicate_facets, 2u);
  EXPECT_EQ(report.changed.unused_points, 2u);
  EXPECT_EQ(report.changed.slits, 0u);
  EXPECT_EQ(report.changed.flipped_facets, 0u);
  EXPECT_EQ(report.verdict, MeshVerdict::repaired);
  EXPECT_EQ(shape(mesh), shape(box_shell({1.0, 1.0, 1.0})));
}

TEST(Repair, ClosesTheSlitOfADroppedFacetByAnEdgeFlip) {
  // Two triangles below, one above the line from (0,0) to (2,0); a flat facet joins them.
  const PolygonSoup soup{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, -1, 0}, {1, 1, 0}},
                         {{0, 3, 1}, {1, 3, 2}, {0, 1, 2}, {0, 2, 4}}};

  const auto [mesh, report] = repaired(soup);

  EXPECT_EQ(report.changed.zero_area_facets, 1u);
  EXPECT_EQ(report.changed.slits, 0u);
  EXPECT_EQ(report.after.facets, 4u);
  EXPECT_EQ(report.after.border_edges, 4u);
  EXPECT_EQ(report.after.area, 2.0);
  EXPECT_EQ(report.after.inconsistent_edges, 0u);
  EXPECT_EQ(report.verdict, MeshVerdict::repaired);
}

TEST(Repair, WarnsOfSlitsThatNoFlipCloses) {
  // As before, but two facets above share the long side, so there is none to be cut.
  const PolygonSoup soup{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, -1, 0}, {1, 1, 0}, {1, 0, 1}},
                         {{0, 3, 1}, {1, 3, 2}, {0, 1, 2}, {0, 2, 4}, {0, 2, 5}}};

  const MeshReport report = repaired(soup).report;

  EXPECT_EQ(report.changed.zero_area_facets, 1u);
  EXPECT_EQ(report.changed.slits, 2u);
  EXPECT_EQ(report.verdict, MeshVerdict::usable_with_warnings);
}

TEST(Repair, WarnsOfAClosedMeshThatBoundsNoVolume) {
  // A box in a box, both facing outward, as their orientation alone would have it.
  PolygonSoup soup = to_soup(box_shell({3.0, 3.0, 3.0}));
  PolygonSoup inner = to_soup(box_shell({1.0, 1.0, 1.0}));
  for (auto& polygon : inner.polygons)
    for (std::size_t& corner : polygon) corner += soup.points.size();
  for (const Vec3& point : inner.points) soup.points.push_back(point + Vec3::Ones());
  soup.polygons.insert(soup.polygons.end(), inner.polygons.begin(), inner.polygons.end());

  const MeshReport report = repaired(soup, {.orient = false}).report;

  ASSERT_EQ(report.after.bounds_volume, false);
  EXPECT_THAT(report.reasons, ElementsAre(HasSubstr("closed but bounds no volume")));
  EXPECT_EQ(report.verdict, MeshVerdict::usable_with_warnings);
}

TEST(Repair, KeepsNeedlesHoweverThin) {
  for (const double height : {1e-7, 1e-12, 1e-30, 1e-300}) {
    PolygonSoup soup;
    for (int k = 0; k <= 50; ++k) {
      soup.points.push_back({1.0 * k, 0, 0});
      soup.points.push_back({1.0 * k, height, 0});
    }
    for (std::size_t k = 0; k < 50; ++k) {
      soup.polygons.push_back({2 * k, 2 * k + 2, 2 * k + 1});
      soup.polygons.push_back({2 * k + 1, 2 * k + 2, 2 * k + 3});
    }

    const MeshReport report = repaired(soup).report;

    EXPECT_EQ(report.after.facets, 100u) << height;
    EXPECT_EQ(report.changed.zero_area_facets, 0u) << height;
    EXPECT_EQ(report.verdict, MeshVerdict::usable_with_warnings);
  }
}

TEST(Repair, CutsPolygonsIntoFacetsOverTheSameNodes) {
  PolygonSoup soup{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {3, 0, 0}, {3, 1, 0}},
                   {{0, 1, 2, 3}, {1, 4, 5, 2, 2}}};

  const MeshReport report = repaired(soup).report;

  EXPECT_EQ(report.found.non_triangles, 2u);
  EXPECT_EQ(report.changed.polygons_cut, 2u);
  EXPECT_EQ(report.after.points, 6u);
  EXPECT_EQ(report.after.facets, 4u);
  EXPECT_EQ(report.after.euler_characteristic, 1);
}

TEST(Repair, RefusesPolygonsThatCrossThemselvesAndNamesThem) {
  PolygonSoup soup = to_soup(icosphere(1.0, 0));
  soup.points.insert(soup.points.end(), {{0, 0, 5}, {1, 1, 5}, {1, 0, 5}, {0, 1, 5}});
  soup.polygons.push_back({12, 13, 14, 15});

  const MeshReport report = repaired(soup).report;

  EXPECT_EQ(report.verdict, MeshVerdict::refused);
  EXPECT_THAT(report.reasons, ElementsAre(HasSubstr("polygon 20 cannot be cut")));
}

TEST(Repair, RefusesASoupThatNamesPointsItDoesNotHave) {
  PolygonSoup soup = to_soup(icosphere(1.0, 0));
  soup.polygons[3][1] = std::numeric_limits<std::size_t>::max();
  EXPECT_THROW(repaired(soup), MeshError);

  soup = to_soup(icosphere(1.0, 0));
  soup.points[5][2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(repaired(soup), MeshError);
}

}  // namespace
}  // namespace plekton::geometry::repair_test
