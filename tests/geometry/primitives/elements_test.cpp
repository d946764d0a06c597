// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/primitives/elements.hpp"

#include "tests/support/complexes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

namespace plekton::geometry::elements_test {
namespace {

using test::Complex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

template <class Id>
std::vector<std::int32_t> numbers(std::span<const Id> ids) {
  std::vector<std::int32_t> result;
  for (const Id id : ids) result.push_back(static_cast<std::int32_t>(id));
  return result;
}

std::string message_of(const Complex& complex) {
  try {
    complex.surface();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

/// All edges, and who is on them, straight from the definition.
struct BruteForce {
  std::set<std::set<NodeId>> edges;
  std::set<std::set<NodeId>> facet_sides;

  explicit BruteForce(const Complex& complex) {
    for (const Facet& facet : complex.facets) {
      for (std::size_t k = 0; k < 3; ++k)
        facet_sides.insert({facet.nodes[k], facet.nodes[(k + 1) % 3]});
    }
    edges = facet_sides;
    for (const Cylinder& cylinder : complex.cylinders)
      edges.insert({cylinder.nodes[0], cylinder.nodes[1]});
  }
};

std::set<NodeId> set_of(std::span<const NodeId> nodes) {
  return {nodes.begin(), nodes.end()};
}

void expect_edges_of_nodes(const Surface& surface, NodeId node) {
  std::vector<std::int32_t> edges;
  for (std::size_t e = 0; e < surface.edge_count(); ++e) {
    if (set_of(surface.nodes_of(id_at<EdgeId>(e))).contains(node))
      edges.push_back(static_cast<std::int32_t>(e));
  }
  std::vector<std::int32_t> faces;
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    if (set_of(surface.nodes_of(id_at<FaceId>(f))).contains(node))
      faces.push_back(static_cast<std::int32_t>(f));
  }
  CellId lowest{-1};
  for (std::size_t c = surface.cell_count(); c-- > 0;) {
    if (set_of(surface.nodes_of(id_at<CellId>(c))).contains(node)) lowest = id_at<CellId>(c);
  }
  EXPECT_EQ(numbers(surface.edges_of(node)), edges);
  EXPECT_EQ(numbers(surface.faces_of(node)), faces);
  EXPECT_EQ(surface.owner_of(node), lowest);
}

void expect_faces_of_edge(const Surface& surface, EdgeId edge) {
  const auto& ends = surface.nodes_of(edge);
  std::vector<std::int32_t> faces;
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    const auto nodes = set_of(surface.nodes_of(id_at<FaceId>(f)));
    if (nodes.contains(ends[0]) && nodes.contains(ends[1]))
      faces.push_back(static_cast<std::int32_t>(f));
  }
  EXPECT_LT(ends[0], ends[1]);
  EXPECT_EQ(numbers(surface.faces_of(edge)), faces);
  if (faces.empty()) {
    EXPECT_GE(index_of(surface.owner_of(edge)), surface.face_count());
    EXPECT_EQ(surface.feature_of(surface.owner_of(edge)), Feature(edge));
  } else {
    EXPECT_EQ(static_cast<std::int32_t>(surface.owner_of(edge)), faces.front());
  }
}

TEST(Surface, HasTheIncidenceOfABruteForceSearchOnRandomComplexes) {
  test::Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const Complex complex = test::random_complex(random, random.coin());
    const Surface surface = complex.surface();
    const BruteForce expected(complex);

    ASSERT_EQ(surface.face_count(), complex.facets.size());
    ASSERT_EQ(surface.node_count(), complex.x.size());
    ASSERT_EQ(surface.edge_count(), expected.edges.size());
    EXPECT_EQ(surface.cell_count(),
              complex.facets.size() + expected.edges.size() - expected.facet_sides.size());
    std::set<std::set<NodeId>> edges;
    for (std::size_t e = 0; e < surface.edge_count(); ++e) {
      edges.insert(set_of(surface.nodes_of(id_at<EdgeId>(e))));
      expect_faces_of_edge(surface, id_at<EdgeId>(e));
    }
    EXPECT_EQ(edges, expected.edges);
    for (std::size_t n = 0; n < surface.node_count(); ++n)
      expect_edges_of_nodes(surface, id_at<NodeId>(n));
    for (std::size_t f = 0; f < surface.face_count(); ++f) {
      const auto& nodes = surface.nodes_of(id_at<FaceId>(f));
      EXPECT_EQ(nodes, complex.facets[f].nodes);
      EXPECT_EQ(surface.feature_of(id_at<CellId>(f)), Feature(id_at<FaceId>(f)));
      for (std::size_t k = 0; k < 3; ++k) {
        const auto side = set_of(surface.nodes_of(surface.edges_of(id_at<FaceId>(f))[k]));
        EXPECT_EQ(side, (std::set{nodes[k], nodes[(k + 1) % 3]}));
      }
    }
  }
}

TEST(Surface, NumbersTheConnectedStructuresByTheirLowestNodes) {
  test::Random random(2);
  for (int trial = 0; trial < 300; ++trial) {
    const Complex complex = test::random_complex(random, true);
    const Surface surface = complex.surface();

    // Spread the lowest number over every cell until nothing changes.
    std::vector<std::size_t> lowest(surface.node_count());
    for (std::size_t n = 0; n < lowest.size(); ++n) lowest[n] = n;
    for (std::size_t round = 0; round < lowest.size(); ++round) {
      for (std::size_t c = 0; c < surface.cell_count(); ++c) {
        const auto nodes = surface.nodes_of(id_at<CellId>(c));
        for (const NodeId a : nodes) {
          for (const NodeId b : nodes)
            lowest[index_of(a)] = std::min(lowest[index_of(a)], lowest[index_of(b)]);
        }
      }
    }
    std::vector<int> expected;
    int structures = 0;
    for (std::size_t n = 0; n < lowest.size(); ++n) {
      const bool used = !surface.edges_of(id_at<NodeId>(n)).empty();
      expected.push_back(!used ? -1 : lowest[n] == n ? structures++ : expected[lowest[n]]);
    }

    EXPECT_EQ(surface.structure_count(), static_cast<std::size_t>(structures));
    for (std::size_t n = 0; n < lowest.size(); ++n) {
      EXPECT_EQ(surface.structure_of(id_at<NodeId>(n)), StructureId{expected[n]});
    }
    for (std::size_t c = 0; c < surface.cell_count(); ++c) {
      for (const NodeId node : surface.nodes_of(id_at<CellId>(c))) {
        EXPECT_EQ(surface.structure_of(id_at<CellId>(c)), surface.structure_of(node));
      }
    }
  }
}

TEST(Surface, JoinsTwoFacetsThatShareAnEdgeIntoOneStructure) {
  Complex square;
  for (int k = 0; k < 4; ++k) square.node(Vec3::Zero());
  square.facet(0, 1, 2);
  square.facet(0, 2, 3);

  EXPECT_EQ(square.surface().structure_count(), 1U);
}

TEST(Surface, HasARadiusForEachStructure) {
  Complex two;
  for (int k = 0; k < 6; ++k) two.node(Vec3::Zero());
  two.cylinder(4, 5);
  two.facet(0, 1, 2);
  two.facets[0].radius = 0.3;

  const Surface surface = two.surface();

  ASSERT_EQ(surface.structure_count(), 2U);
  EXPECT_EQ(surface.radius(surface.structure_of(NodeId{0})), 0.3);
  EXPECT_EQ(surface.radius(surface.structure_of(NodeId{5})), 0.1);
  EXPECT_EQ(surface.structure_of(NodeId{3}), StructureId{-1});
}

TEST(Surface, KnowsWhichStructuresHaveFacetsOrHadSome) {
  Complex two;
  for (int k = 0; k < 6; ++k) two.node(Vec3::Zero());
  two.cylinder(4, 5);
  two.facet(0, 1, 2);
  two.cylinder(2, 3);

  const Surface surface = two.surface();
  const std::vector<Cylinder> bars{two.cylinders[0], two.cylinders[1]};
  const Surface left = surface.left_with(bars, {});

  for (const Surface& of : {surface, left}) {
    EXPECT_TRUE(of.is_sheet(surface.structure_of(NodeId{3})));
    EXPECT_FALSE(of.is_sheet(surface.structure_of(NodeId{4})));
  }
}

TEST(Surface, TakesACylinderOnASideOfAFacetAsTheRimOfTheFacet) {
  Complex rimmed;
  for (int k = 0; k < 4; ++k) rimmed.node(Vec3::Zero());
  rimmed.facet(0, 1, 2);
  rimmed.cylinder(1, 0);
  rimmed.cylinder(2, 3);
  rimmed.cylinder(3, 2);  // once more

  const Surface surface = rimmed.surface();

  EXPECT_EQ(surface.edge_count(), 4U);
  EXPECT_EQ(surface.cell_count(), 2U);
  EXPECT_EQ(surface.owner_of(EdgeId{0}), CellId{0});
  EXPECT_EQ(surface.feature_of(CellId{1}), Feature(EdgeId{3}));
  EXPECT_THAT(surface.nodes_of(CellId{1}), ElementsAre(NodeId{2}, NodeId{3}));
  EXPECT_EQ(surface.owner_of(NodeId{2}), CellId{0});
  EXPECT_EQ(surface.owner_of(NodeId{3}), CellId{1});
}

TEST(Surface, GivesTheSameEdgesForAnyOrderOfFacetsAndNodes) {
  test::Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    Complex complex = test::random_complex(random, true);
    const Surface first = complex.surface();
    std::mt19937 shuffle(static_cast<unsigned>(trial));
    std::shuffle(complex.facets.begin(), complex.facets.end(), shuffle);
    for (Facet& facet : complex.facets)
      std::shuffle(facet.nodes.begin(), facet.nodes.end(), shuffle);
    std::shuffle(complex.cylinders.begin(), complex.cylinders.end(), shuffle);

    const Surface second = complex.surface();

    ASSERT_EQ(first.edge_count(), second.edge_count());
    for (std::size_t e = 0; e < first.edge_count(); ++e) {
      EXPECT_EQ(first.nodes_of(id_at<EdgeId>(e)), second.nodes_of(id_at<EdgeId>(e)));
    }
    EXPECT_EQ(first.euler_characteristic(), second.euler_characteristic());
    EXPECT_EQ(first.structure_count(), second.structure_count());
  }
}

TEST(Surface, KnowsTheEulerCharacteristic) {
  EXPECT_EQ(Surface().euler_characteristic(), 0);
  EXPECT_EQ(test::cube(4).surface().euler_characteristic(), 2);
  EXPECT_EQ(test::ball(2).surface().euler_characteristic(), 2);
  EXPECT_EQ(test::sheet(3).surface().euler_characteristic(), 1);
  EXPECT_EQ(test::net(3).surface().euler_characteristic(), 1 - 9);  // nine apertures
  EXPECT_EQ(test::book({0, 90, 180, 270}).surface().euler_characteristic(), 1);
  EXPECT_EQ(test::bow_tie().surface().euler_characteristic(), 1);
}

TEST(Surface, MayBeEmpty) {
  const Surface surface({}, {}, 2);

  EXPECT_EQ(surface.cell_count(), 0U);
  EXPECT_EQ(surface.structure_count(), 0U);
  EXPECT_EQ(surface.euler_characteristic(), 0);
  EXPECT_THAT(surface.edges_of(NodeId{1}), IsEmpty());
}

TEST(SurfaceErrors, ListEveryProblemAtOnce) {
  Complex bad;
  for (int k = 0; k < 8; ++k) bad.node(Vec3::Zero());
  bad.facet(0, 1, 2);
  bad.facet(3, 4, 3);   // repeats
  bad.facet(2, 0, 1);   // same as facet 0
  bad.facet(0, 1, 8);   // out of range
  bad.facet(-1, 1, 3);  // out of range
  bad.facet(2, 3, 4);
  bad.facets[5].radius = 0.2;  // connected to facet 0
  bad.cylinder(5, 5);          // repeats
  bad.cylinder(6, 99);         // out of range
  bad.cylinder(5, 6);
  bad.cylinders[2].radius = -1.0;
  bad.cylinder(6, 7);
  bad.cylinders[3].radius = std::numeric_limits<double>::quiet_NaN();
  bad.cylinder(5, 7);
  bad.cylinders[4].radius = std::numeric_limits<double>::infinity();
  bad.cylinder(4, 5);
  bad.cylinders[5].radius = 0.3;

  const std::string message = message_of(bad);

  EXPECT_THAT(
      message,
      HasSubstr("surface: facet 1 repeats node 3; merge duplicate nodes or delete the element"));
  EXPECT_THAT(message,
              HasSubstr("surface: facet 2 has the same nodes as facet 0; delete one of them"));
  EXPECT_THAT(message, HasSubstr("surface: facet 3 names node 8, but there are 8 nodes"));
  EXPECT_THAT(message, HasSubstr("surface: facet 4 names node -1, but there are 8 nodes"));
  EXPECT_THAT(
      message,
      HasSubstr(
          "surface: facet 5 has radius 0.2 m, but it is connected to elements of radius 0.1 m"));
  EXPECT_THAT(message, HasSubstr("surface: cylinder 0 repeats node 5"));
  EXPECT_THAT(message, HasSubstr("surface: cylinder 1 names node 99, but there are 8 nodes"));
  EXPECT_THAT(
      message,
      HasSubstr("surface: cylinder 2 has radius -1 m; it must be at least 0 and below 1e+75 m"));
  EXPECT_THAT(message, HasSubstr("surface: cylinder 3 has radius nan m; it must be at least 0"));
  EXPECT_THAT(
      message,
      HasSubstr("surface: cylinder 4 has radius inf m; it must be at least 0 and below 1e+75 m"));
  EXPECT_THAT(
      message,
      HasSubstr(
          "surface: cylinder 5 has radius 0.3 m, but it is connected to elements of radius 0.1 m"));
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 10);
  EXPECT_NE(message.back(), '\n');
}

TEST(SurfaceErrors, NameARimOfAnotherRadius) {
  Complex rimmed;
  for (int k = 0; k < 3; ++k) rimmed.node(Vec3::Zero());
  rimmed.facet(0, 1, 2);
  rimmed.cylinder(0, 1);
  rimmed.cylinders[0].radius = 0.05;

  EXPECT_EQ(message_of(rimmed),
            "surface: cylinder 0 has radius 0.05 m, but it is connected to elements of radius 0.1 "
            "m; all connected "
            "facets and cylinders need the same radius");
}

TEST(SurfaceErrors, DoNotComplainAboutLooseStructuresOfDifferentRadii) {
  Complex loose;
  for (int k = 0; k < 4; ++k) loose.node(Vec3::Zero());
  loose.cylinder(0, 1);
  loose.cylinder(2, 3);
  loose.cylinders[1].radius = 0.7;

  EXPECT_EQ(message_of(loose), "");
}

TEST(Surface, NamesThePlacesOfItsCellsInTheTables) {
  Complex complex;
  for (int k = 0; k < 6; ++k) complex.node(Vec3::Zero());
  complex.facet(3, 4, 5);
  complex.cylinder(5, 2);
  complex.cylinder(4, 3);  // along the facet: no cell
  complex.cylinder(1, 0);
  complex.cylinder(2, 5);  // along the first one
  const Surface surface = complex.surface();

  ASSERT_EQ(surface.cell_count(), 3U);
  EXPECT_EQ(surface.place_of(CellId{0}), 0U);
  for (const CellId cell : {CellId{1}, CellId{2}}) {
    const auto& nodes = complex.cylinders[surface.place_of(cell)].nodes;
    EXPECT_TRUE(std::is_permutation(nodes.begin(), nodes.end(), surface.nodes_of(cell).begin()));
  }
  EXPECT_EQ(surface.place_of(CellId{1}), 2U);
  EXPECT_EQ(surface.place_of(CellId{2}), 0U);
}

TEST(Surface, MayBeWithoutThickness) {
  Complex complex = test::sheet(1);
  for (Facet& facet : complex.facets) facet.radius = 0.0;
  const Surface surface = complex.surface();
  EXPECT_EQ(surface.radius(surface.structure_of(CellId{0})), 0.0);
}

TEST(SurfaceErrors, NameANumberOfNodesThatNoIdCounts) {
  for (const std::size_t count :
       {std::size_t{3000000000}, std::numeric_limits<std::size_t>::max()}) {
    try {
      Surface surface({}, {}, count);
      FAIL() << "was accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(),
                "surface: " + std::to_string(count) + " nodes; their numbers end at 2147483647");
    }
  }
}

}  // namespace
}  // namespace plekton::geometry::elements_test
