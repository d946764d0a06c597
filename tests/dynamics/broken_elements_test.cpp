// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/broken_elements.hpp"

#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/sheet_facets.hpp"
#include "tests/support/breaking_net.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace plekton::dynamics::broken_elements_test {
namespace {

using test::bond_between;
using testing::UnorderedElementsAre;
using Edge = std::pair<int, int>;

/// Two facets 0 1 2 and 1 3 2 with bonds along all sides, and a cylinder 3 4.
class TwoFacets : public testing::Test {
 protected:
  TwoFacets() {
    for (const Vec3& x :
         {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(2, 1, 0)})
      scene.add_node(x);
    for (const auto& [a, b] : {Edge{0, 1}, {1, 2}, {2, 0}, {1, 3}, {3, 2}, {3, 4}})
      scene.add_beam(NodeId{a}, NodeId{b}, circular_section(0.01, 1e8, 0.3), 1000.0);
    scene.add_facet(NodeId{0}, NodeId{1}, NodeId{2}, 0.01, contact::MaterialId{7});
    scene.add_facet(NodeId{1}, NodeId{3}, NodeId{2}, 0.01, contact::MaterialId{7});
    scene.add_cylinder(NodeId{3}, NodeId{4}, 0.01, contact::MaterialId{7});
  }

  bool take_out(int a, int b) {
    BeamBonds bonds(scene.bonds, scene.state.size());
    for (const std::size_t bond : broken) bonds.break_bond(bond);
    broken.push_back(bond_between(scene.bonds, NodeId{a}, NodeId{b}));
    bonds.break_bond(broken.back());
    const SheetFacets sheets(scene.sheet_facets, scene.state.size());
    return take_out_broken(scene, {{broken.back()}, {}, {}}, bonds, sheets);
  }

  std::vector<Edge> cylinders() const {
    std::vector<Edge> edges;
    for (const auto& cylinder : scene.elements.cylinders) {
      const auto [low, high] = std::minmax(cylinder.nodes[0], cylinder.nodes[1]);
      edges.emplace_back(static_cast<int>(low), static_cast<int>(high));
    }
    return edges;
  }

  Scene scene;
  std::vector<std::size_t> broken;
};

TEST_F(TwoFacets, ACylinderGoesWithItsBond) {
  EXPECT_TRUE(take_out(3, 4));

  EXPECT_TRUE(scene.elements.cylinders.empty());
  EXPECT_TRUE(scene.cylinder_materials.empty());
  EXPECT_EQ(scene.elements.facets.size(), 2u);
}

TEST_F(TwoFacets, BothFacetsAtABrokenSideAreTornAndTheirOtherSidesStayAsCylinders) {
  EXPECT_TRUE(take_out(1, 2));

  EXPECT_TRUE(scene.elements.facets.empty());
  EXPECT_THAT(cylinders(),
              UnorderedElementsAre(Edge{0, 1}, Edge{0, 2}, Edge{1, 3}, Edge{2, 3}, Edge{3, 4}));
  EXPECT_EQ(scene.cylinder_materials, std::vector<contact::MaterialId>(5, contact::MaterialId{7}));
  for (const auto& cylinder : scene.elements.cylinders) EXPECT_EQ(cylinder.radius, 0.01);
}

TEST_F(TwoFacets, ASideOfAnotherFacetNeedsNoCylinder) {
  EXPECT_TRUE(take_out(0, 1));

  EXPECT_EQ(scene.elements.facets.size(), 1u);
  EXPECT_THAT(cylinders(), UnorderedElementsAre(Edge{0, 2}, Edge{3, 4}));
}

TEST_F(TwoFacets, NothingIsLeftOfASideWhoseBondBrokeBefore) {
  EXPECT_TRUE(take_out(0, 1));
  EXPECT_TRUE(take_out(0, 2));

  EXPECT_THAT(cylinders(), UnorderedElementsAre(Edge{3, 4}));
}

TEST_F(TwoFacets, ASecondBondHoldsTheEdge) {
  scene.add_beam(NodeId{2}, NodeId{1}, circular_section(0.01, 1e8, 0.3), 1000.0);

  EXPECT_FALSE(take_out(1, 2));

  EXPECT_EQ(scene.elements.facets.size(), 2u);
}

TEST_F(TwoFacets, ASheetCarriesItsFacetWithoutTheBond) {
  scene.add_sheet_facet({NodeId{2}, NodeId{0}, NodeId{1}}, solid_sheet(0.02, 1e6, 0.3), 1000.0);

  EXPECT_TRUE(take_out(1, 2));

  ASSERT_EQ(scene.elements.facets.size(), 1u);
  EXPECT_EQ(scene.elements.facets[0].nodes[0], NodeId{0});
}

TEST_F(TwoFacets, ABondWithoutElementsTakesNothingAway) {
  scene.add_beam(NodeId{0}, NodeId{4}, circular_section(0.01, 1e8, 0.3), 1000.0);

  EXPECT_FALSE(take_out(0, 4));
}

}  // namespace
}  // namespace plekton::dynamics::broken_elements_test
