// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/close_slits.hpp"
#include "geometry/mesh/edge_table.hpp"
#include "geometry/mesh/repair/measures.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace plekton::geometry::close_slits_test {
namespace {

std::array<NodeId, 3> nodes(std::int32_t a, std::int32_t b, std::int32_t c) {
  return {NodeId{a}, NodeId{b}, NodeId{c}};
}

/// n + 1 points on a line, a facet above its whole length, and facets below each piece of it.
Mesh comb(std::int32_t pieces) {
  Mesh mesh;
  for (std::int32_t k = 0; k <= pieces; ++k) mesh.points.emplace_back(0.25 * k, 0.0, 0.0);
  mesh.points.emplace_back(0.1, 1.0, 0.5);   // above
  mesh.points.emplace_back(0.1, -1.0, 0.0);  // below
  mesh.facets.push_back(nodes(0, pieces, pieces + 1));
  for (std::int32_t k = 0; k < pieces; ++k) mesh.facets.push_back(nodes(k + 1, k, pieces + 2));
  return mesh;
}

// Flat facets one on the other close from the long side down, whatever order they come in.
TEST(CloseSlits, ClosesChainsOfFlatFacets) {
  const std::vector<std::array<NodeId, 3>> chain = {nodes(1, 0, 2), nodes(0, 2, 3), nodes(3, 4, 0)};
  for (const bool backwards : {false, true}) {
    Mesh mesh = comb(4);
    const double area = measure(mesh, false).area;
    auto dropped = chain;
    if (backwards) std::reverse(dropped.begin(), dropped.end());

    EXPECT_EQ(close_slits(mesh, dropped), 3U);

    const MeshMeasures after = measure(mesh, true);
    EXPECT_EQ(after.facets, 8U);
    EXPECT_EQ(after.border_edges, 4U);
    EXPECT_EQ(after.inconsistent_edges, 0U);
    EXPECT_EQ(after.self_intersections, 0U);
    EXPECT_NEAR(after.area, area, 4e-16 * area);
  }
}

TEST(CloseSlits, LeavesABorderAlone) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}};
  mesh.facets = {nodes(0, 2, 3)};

  EXPECT_EQ(close_slits(mesh, std::vector{nodes(0, 1, 2)}), 0U);
  EXPECT_EQ(mesh.facets.size(), 1U);
}

TEST(CloseSlits, MakesNoEdgeWithMoreThanTwoFacets) {
  Mesh mesh = comb(2);
  mesh.points.emplace_back(0.0, 0.0, 5.0);
  mesh.facets.push_back(nodes(1, 3, 5));  // holds the edge that a flip would make

  EXPECT_EQ(close_slits(mesh, std::vector{nodes(0, 1, 2)}), 0U);
}

}  // namespace
}  // namespace plekton::geometry::close_slits_test
