// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/repair/orientation.hpp"
#include "tests/support/meshes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace plekton::geometry::orientation_test {
namespace {

using test::inside_out;
using test::repaired;
using test::shape;
using test::together;
using ::testing::HasSubstr;

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
    const double u = 2.0 * std::numbers::pi * k / kCells;
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
}  // namespace plekton::geometry::orientation_test
