// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/disjoint_sets.hpp"
#include "geometry/mesh/generators.hpp"
#include "geometry/mesh/repair.hpp"
#include "geometry/mesh/weld.hpp"
#include "tests/support/seeded_random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace plekton::geometry {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Repaired {
  Mesh mesh;
  MeshReport report;
};

Repaired repaired(const PolygonSoup& soup, const RepairOptions& options = {}) {
  Repaired result;
  result.mesh = repair(soup, options, result.report);
  return result;
}

/// Every facet with its own points, as in an STL file.
PolygonSoup unshared(const Mesh& mesh) {
  PolygonSoup soup;
  for (const auto& facet : mesh.facets) {
    auto& polygon = soup.polygons.emplace_back();
    for (const NodeId node : facet) {
      polygon.push_back(soup.points.size());
      soup.points.push_back(mesh.points[index_of(node)]);
    }
  }
  return soup;
}

/// Facets as sets of positions: what a mesh is, however it is numbered.
std::set<std::vector<std::array<double, 3>>> shape(const Mesh& mesh) {
  std::set<std::vector<std::array<double, 3>>> facets;
  for (const auto& facet : mesh.facets) {
    std::vector<std::array<double, 3>> corners;
    for (const NodeId node : facet) {
      const Vec3& p = mesh.points[index_of(node)];
      corners.push_back({p[0], p[1], p[2]});
    }
    // Cyclic order is the same facet, the reverse is not.
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    facets.insert(corners);
  }
  return facets;
}

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

TEST(Repair, WarnsOfSlitsThatADroppedFacetLeaves) {
  // Two triangles below, one above the line from (0,0) to (2,0); a flat facet joins them.
  const PolygonSoup soup{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, -1, 0}, {1, 1, 0}},
                         {{0, 3, 1}, {1, 3, 2}, {0, 1, 2}, {0, 2, 4}}};

  const MeshReport report = repaired(soup).report;

  EXPECT_EQ(report.changed.zero_area_facets, 1u);
  EXPECT_EQ(report.changed.slits, 3u);
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

TEST(Orientation, TurnsTheMinorityOver) {
  Mesh mesh = plane_sheet({.width = 1.0, .length = 1.0, .cells_x = 8, .cells_y = 8});
  for (std::size_t f = 0; f < mesh.facets.size(); f += 5)
    std::swap(mesh.facets[f][0], mesh.facets[f][2]);

  const auto [result, report] = repaired(to_soup(mesh));

  EXPECT_EQ(report.changed.flipped_facets, 26u);
  EXPECT_GT(report.found.inconsistent_edges, 0u);
  EXPECT_EQ(report.after.inconsistent_edges, 0u);
  EXPECT_EQ(shape(result),
            shape(plane_sheet({.width = 1.0, .length = 1.0, .cells_x = 8, .cells_y = 8})));
}

TEST(Orientation, LeavesFacetsAloneWhenNotWanted) {
  Mesh mesh = box_shell({1.0, 1.0, 1.0});
  std::swap(mesh.facets[0][0], mesh.facets[0][1]);

  const auto [result, report] = repaired(to_soup(mesh), {.orient = false});

  EXPECT_EQ(result.facets, mesh.facets);
  EXPECT_EQ(report.after.inconsistent_edges, 3u);
  EXPECT_EQ(report.verdict, MeshVerdict::usable_with_warnings);
}

/// Meshes side by side, sharing nothing.
Mesh together(const std::vector<Mesh>& parts) {
  Mesh all;
  for (const Mesh& part : parts) {
    const std::size_t first = all.points.size();
    all.points.insert(all.points.end(), part.points.begin(), part.points.end());
    for (auto facet : part.facets) {
      for (NodeId& node : facet) node = id_at<NodeId>(index_of(node) + first);
      all.facets.push_back(facet);
    }
  }
  return all;
}

Mesh inside_out(Mesh mesh) {
  for (auto& facet : mesh.facets) std::swap(facet[1], facet[2]);
  return mesh;
}

TEST(Orientation, TurnsClosedPartsOutwardAlsoFarFromTheOrigin) {
  Mesh mesh = inside_out(icosphere(1e-3, 2));
  for (Vec3& p : mesh.points) p += Vec3(1e6, -1e6, 1e6);

  const MeshReport report = repaired(to_soup(mesh)).report;

  EXPECT_EQ(report.changed.flipped_facets, 320u);
  EXPECT_GT(report.after.volume.value(), 0.0);
}

TEST(Orientation, KeepsCavitiesInward) {
  const Mesh mesh = together({icosphere(3.0, 1), inside_out(icosphere(2.0, 1)), icosphere(1.0, 1)});

  const MeshReport report = repaired(to_soup(mesh)).report;

  EXPECT_EQ(report.changed.flipped_facets, 0u);
  EXPECT_EQ(report.after.bounds_volume, true);
}

TEST(Orientation, TurnsAnInwardPartInsideACavityOutward) {
  const Mesh mesh =
      together({icosphere(3.0, 1), inside_out(icosphere(2.0, 1)), inside_out(icosphere(1.0, 1))});

  EXPECT_EQ(repaired(to_soup(mesh)).report.changed.flipped_facets, 80u);
}

/// Three sheets of facets on one edge.
PolygonSoup fin() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
          {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
}

TEST(NonManifold, KeepsAnEdgeWithThreeFacetsShared) {
  const MeshReport report = repaired(fin()).report;

  EXPECT_EQ(report.after.points, 5u);
  EXPECT_EQ(report.after.many_facet_edges, 1u);
  EXPECT_EQ(report.after.non_manifold_nodes, 2u);
  EXPECT_EQ(report.after.components, 1u);
  EXPECT_EQ(report.after.self_intersections, 0u) << "facets that share an edge do not intersect";
  EXPECT_EQ(report.changed.flipped_facets, 0u);
  EXPECT_EQ(report.verdict, MeshVerdict::usable_with_warnings);
}

TEST(NonManifold, KeepsTheNodeOfABowTieShared) {
  PolygonSoup soup{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
      {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}}};

  const MeshReport report = repaired(soup).report;

  EXPECT_EQ(report.after.points, 7u);
  EXPECT_EQ(report.after.non_manifold_nodes, 1u);
  EXPECT_EQ(report.after.components, 1u);
  EXPECT_TRUE(report.after.closed);
  EXPECT_NEAR(report.after.volume.value(), 1.0 / 3.0, 1e-15) << "both tetrahedra face outward";
}

TEST(NonManifold, KeepsAMoebiusBandWholeAndSaysIt) {
  constexpr int kCells = 12;
  PolygonSoup soup;
  for (int k = 0; k < kCells; ++k) {
    const double u = 2.0 * std::acos(-1.0) * k / kCells;
    for (const double v : {-0.3, 0.3}) {
      const double r = 1.0 + v * std::cos(u / 2.0);
      soup.points.push_back({r * std::cos(u), r * std::sin(u), v * std::sin(u / 2.0)});
    }
  }
  for (std::size_t k = 0; k < kCells; ++k) {
    const bool last = k + 1 == kCells;
    const std::size_t a = 2 * k, b = 2 * k + 1, c = last ? 1 : 2 * k + 2, d = last ? 0 : 2 * k + 3;
    soup.polygons.push_back({a, c, b});
    soup.polygons.push_back({b, c, d});
  }

  const auto [mesh, report] = repaired(soup);

  EXPECT_EQ(report.after.points, 24u);
  EXPECT_EQ(report.after.facets, 24u);
  EXPECT_EQ(report.after.non_orientable_patches, 1u);
  EXPECT_EQ(report.after.euler_characteristic, 0);
  EXPECT_EQ(report.after.many_facet_edges, 0u);
  EXPECT_EQ(report.changed.flipped_facets, 0u);
  EXPECT_THAT(report.reasons, ::testing::Contains(HasSubstr("only one side")));
}

TEST(NonManifold, KeepsTheWallBetweenTwoTetrahedraOnce) {
  PolygonSoup soup{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 1, 2}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}}};

  const MeshReport report = repaired(soup).report;

  EXPECT_EQ(report.after.points, 5u);
  EXPECT_EQ(report.changed.duplicate_facets, 1u);
  EXPECT_EQ(report.after.facets, 7u);
  EXPECT_EQ(report.after.many_facet_edges, 3u);
  EXPECT_EQ(report.after.border_edges, 0u);
  EXPECT_EQ(report.after.volume, std::nullopt) << "a wall inside has no outside";
}

TEST(NonManifold, TurnsEachOfTwoCubesOnACommonEdgeOutward) {
  Mesh mesh = together({box_shell({1.0, 1.0, 1.0}), inside_out(box_shell({1.0, 1.0, 1.0}))});
  for (std::size_t i = 8; i < 16; ++i) mesh.points[i] += Vec3(1.0, 1.0, 0.0);

  const MeshReport report = repaired(to_soup(mesh)).report;

  EXPECT_EQ(report.after.points, 14u);
  EXPECT_EQ(report.after.many_facet_edges, 1u);
  EXPECT_EQ(report.changed.flipped_facets, 12u);
  EXPECT_EQ(report.after.volume, 2.0);
}

TEST(SelfIntersections, AreFoundOnceEachAndOnlyBeyondWhatFacetsShare) {
  const auto pairs_of = [](const PolygonSoup& soup) {
    return repaired(soup).report.after.self_intersections;
  };
  const std::vector<Vec3> x = {{0, 0, 0}, {4, 0, 0},   {0, 4, 0}, {1, 1, -1},
                               {1, 1, 1}, {-5, -5, 0}, {1, 2, 0}, {1, 5, 0}};

  EXPECT_EQ(pairs_of({x, {{0, 1, 2}, {3, 4, 5}}}), 1u) << "crossing";
  EXPECT_EQ(pairs_of({x, {{0, 1, 2}, {0, 3, 4}}}), 1u) << "crossing, one node shared";
  EXPECT_EQ(pairs_of({x, {{0, 1, 2}, {0, 4, 5}}}), 0u) << "touching in the shared node only";
  EXPECT_EQ(pairs_of({x, {{0, 1, 2}, {0, 1, 6}}}), 1u)
      << "in one plane on the same side of the shared edge";
  EXPECT_EQ(pairs_of({x, {{0, 1, 2}, {1, 0, 5}}}), 0u) << "in one plane on different sides";
  EXPECT_EQ(pairs_of({x, {{0, 1, 2}, {1, 2, 4}}}), 0u) << "hinged";
}

}  // namespace
}  // namespace plekton::geometry
