// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/edge_table.hpp"
#include "geometry/mesh/generate/membrane.hpp"
#include "geometry/mesh/io/import.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace plekton::geometry::hammock_test {
namespace {

const std::filesystem::path kHammock =
    std::filesystem::path(PLEKTON_SOURCE_DIR) / "apps/examples/catch/hammock.stl";

// 21 x 21 cells: V = 22², F = 2 * 21², E = V + F - 1. The flaws are those that make_hammock.py
// lists.
TEST(Hammock, IsACleanOpenSheetAfterWelding) {
  const auto [mesh, report] = import_mesh(kHammock, {{.weld_distance = 1e-6}});

  EXPECT_EQ(report.found.points, 3u * 884);
  EXPECT_EQ(report.found.polygons, 884u);
  EXPECT_EQ(report.changed.points_merged, 1676u);
  EXPECT_EQ(report.changed.points_welded, 491u);
  EXPECT_EQ(report.changed.zero_area_facets, 1u);
  EXPECT_EQ(report.changed.duplicate_facets, 1u);
  EXPECT_EQ(report.changed.repeated_node_facets, 0u);
  EXPECT_EQ(report.changed.flipped_facets, 37u);
  EXPECT_EQ(report.changed.unused_points, 1u);
  EXPECT_EQ(report.after.points, 484u);
  EXPECT_EQ(report.after.facets, 882u);
  EXPECT_EQ(report.after.edges, 1365u);
  EXPECT_EQ(report.after.border_edges, 84u);
  EXPECT_EQ(report.after.components, 1u);
  EXPECT_EQ(report.after.euler_characteristic, 1);
  EXPECT_EQ(report.after.non_manifold_nodes, 0u);
  EXPECT_EQ(report.after.self_intersections, 0u);
  EXPECT_EQ(report.verdict, MeshVerdict::repaired);
}

TEST(Hammock, HasAllItsBorderOnTheRim) {
  const Mesh mesh = import_mesh(kHammock, {{.weld_distance = 1e-6}}).mesh;
  const EdgeTable edges(mesh);

  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges.uses(e).size() != 1) continue;
    for (const NodeId node : edges.edges()[e]) {
      const Vec3& p = mesh.points[index_of(node)];
      // The points of the file are up to 1e-7 m off in each coordinate.
      EXPECT_NEAR(std::max(std::abs(p.x()), std::abs(p.y())), 0.2, 1e-7);
      EXPECT_GE(p.z(), -1e-7);
    }
  }
}

TEST(Hammock, FallsApartWithoutWelding) {
  const MeshReport report = import_mesh(kHammock).report;

  EXPECT_GT(report.after.components, 1u);
  EXPECT_GT(report.after.border_edges, 84u);
  EXPECT_EQ(report.found.near_duplicate_points, 491u) << "the report says that welding would help";
  EXPECT_EQ(report.verdict, MeshVerdict::usable_with_warnings);
}

TEST(Hammock, MakesAMembraneOfAGeotextile) {
  const Mesh mesh = import_mesh(kHammock, {{.weld_distance = 1e-6}}).mesh;

  EXPECT_TRUE(make_membrane(mesh, {.thickness = 3e-3}).warnings.empty());
}

}  // namespace
}  // namespace plekton::geometry::hammock_test
