// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/edge_table.hpp"

#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

namespace plekton::geometry::edge_table_test {
namespace {

/// Facets at random over so few nodes that many share an edge, some of them twice the same way.
Mesh random_mesh(test::Random& random) {
  Mesh mesh;
  mesh.points.resize(7, Vec3::Zero());
  for (int f = random.integer(1, 30); f > 0; --f) {
    std::array<int, 3> nodes{};
    while (nodes[0] == nodes[1] || nodes[1] == nodes[2] || nodes[2] == nodes[0])
      for (int& node : nodes) node = random.integer(0, 6);
    mesh.facets.push_back({NodeId{nodes[0]}, NodeId{nodes[1]}, NodeId{nodes[2]}});
  }
  return mesh;
}

/// By nodes, the lower one first: facets that have both, and whether they go from the lower one.
using Sides = std::map<std::array<NodeId, 2>, std::vector<std::pair<std::uint32_t, bool>>>;

Sides sides_of(const Mesh& mesh) {
  Sides sides;
  for (std::uint32_t f = 0; f < mesh.facets.size(); ++f) {
    const auto [a, b, c] = mesh.facets[f];
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      sides[std::array{std::min(from, to), std::max(from, to)}].emplace_back(f, from < to);
  }
  return sides;
}

TEST(EdgeTable, HasEveryEdgeOnceWithItsFacetsWhateverTheMesh) {
  test::Random random(1);
  std::size_t most = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Mesh mesh = random_mesh(random);
    const Sides sides = sides_of(mesh);

    const EdgeTable table(mesh);

    ASSERT_EQ(table.size(), sides.size());
    std::size_t e = 0;
    for (const auto& [nodes, expected] : sides) {  // in ascending order, as a map is
      ASSERT_EQ(table.edges()[e], nodes);
      std::vector<std::pair<std::uint32_t, bool>> uses;
      for (const EdgeUse& use : table.uses(e)) uses.emplace_back(use.facet, use.forward);
      ASSERT_EQ(uses, expected);
      most = std::max(most, uses.size());
      ++e;
    }
  }
  EXPECT_GT(most, 4u) << "edges of many facets were among them";
}

TEST(EdgeTable, HasTheSidesOfAFacetInTheOrderOfItsCorners) {
  test::Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Mesh mesh = random_mesh(random);

    const EdgeTable table(mesh);

    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        auto side = std::array{mesh.facets[f][k], mesh.facets[f][(k + 1) % 3]};
        std::sort(side.begin(), side.end());
        ASSERT_EQ(table.edges()[table.edges_of(f)[k]], side) << "side " << k << " of " << f;
      }
    }
  }
}

TEST(EdgeTable, SeesAClosedSurfaceFromBothSidesOfEachEdge) {
  const Mesh sphere = icosphere(1.0, 3);

  const EdgeTable table(sphere);

  // Euler: V - E + F = 2.
  EXPECT_EQ(table.size() + 2, sphere.points.size() + sphere.facets.size());
  for (std::size_t e = 0; e < table.size(); ++e) {
    ASSERT_EQ(table.uses(e).size(), 2u);
    EXPECT_NE(table.uses(e)[0].forward, table.uses(e)[1].forward);
  }
}

TEST(EdgeTable, IsEmptyWithoutFacetsAndRefusesCornersThatAreNotThere) {
  EXPECT_EQ(EdgeTable(Mesh{{Vec3::Zero()}, {}}).size(), 0u);
  EXPECT_THROW(EdgeTable(Mesh{{Vec3::Zero()}, {{NodeId{0}, NodeId{1}, NodeId{2}}}}), MeshError);
}

}  // namespace
}  // namespace plekton::geometry::edge_table_test
