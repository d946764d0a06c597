// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/takeover/yade_grid.hpp"

#include "tests/apps/takeover/grid_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plekton::apps::yade::yade_grid_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

TEST(YadeGrid, JoinsWhatConnectionsAndFacetsJoin) {
  std::vector<std::string> notes;

  const std::vector<Grid> grids = grids_of(grid_scene(), notes);

  ASSERT_EQ(grids.size(), 2u);
  EXPECT_EQ(grids[0].nodes.size(), 5u);
  EXPECT_EQ(grids[0].facets, (std::vector<std::array<std::size_t, 3>>{{0, 1, 2}}));
  // The sides of the facet are bars already.
  EXPECT_EQ(grids[0].bars, (std::vector<std::array<std::size_t, 2>>{{0, 3}, {2, 3}, {2, 4}}));
  EXPECT_EQ(grids[1].bars, (std::vector<std::array<std::size_t, 2>>{{0, 1}}));
  EXPECT_THAT(notes, testing::Each(HasSubstr("2 r / length")));
}

TEST(YadeGrid, FindsTheBeamOfTheStiffnesses) {
  std::vector<std::string> notes;

  const Grid grid = grids_of(grid_scene(), notes).at(0);

  EXPECT_NEAR(grid.young_modulus, kGridModulus, 1e-9 * kGridModulus);
  EXPECT_NEAR(grid.poisson_ratio, 0.3, 1e-9);
  EXPECT_NEAR(grid.density, 1000.0, 1e-9 * 1000.0);
  EXPECT_TRUE(grid.bends);
  EXPECT_EQ(grid.strength, 0.0);
}

TEST(YadeGrid, IsOfBarsWhereBeamsDoNotBend) {
  Scene scene = grid_scene();
  for (Bond& bond : scene.bonds) bond.bending_stiffness = bond.twisting_stiffness = 0.0;
  std::vector<std::string> notes;

  EXPECT_FALSE(grids_of(scene, notes).at(0).bends);
}

TEST(YadeGrid, BreaksWhereItsBeamsDo) {
  Scene scene = grid_scene();
  for (Bond& bond : scene.bonds) bond.adhesion = 200.0;
  std::vector<std::string> notes;

  EXPECT_NEAR(grids_of(scene, notes).at(0).strength,
              200.0 / (std::numbers::pi * kGridRadius * kGridRadius), 1e-6);
}

TEST(YadeGrid, SaysWhatAMembraneCannotSay) {
  Scene scene = grid_scene();
  scene.nodes[4].position += Vec3(0.01, 0.0, 0.0);  // stretches the tail by 1 %
  scene.bonds[5].force = 31.4;
  scene.bonds[0].normal_stiffness *= 2.0;
  scene.nodes[0].mass *= 1.5;
  scene.pfacets[0].radius *= 1.1;
  GridNode single;
  single.id = 99;
  scene.nodes.push_back(single);
  scene.bonds.erase(scene.bonds.begin() + 3);
  std::vector<std::string> notes;

  grids_of(scene, notes);

  EXPECT_THAT(notes, Contains(HasSubstr("stretched by up to 1 % (31.4 N)")));
  EXPECT_THAT(notes, Contains(HasSubstr("moduli of its beams differ by up to 1e+02 %")));
  EXPECT_THAT(notes, Contains(HasSubstr("the mass of nodes differs")));
  EXPECT_THAT(notes, Contains(HasSubstr("radii differ by up to 10 %")));
  EXPECT_THAT(notes, Contains(HasSubstr("1 grid nodes without a connection: left out")));
  EXPECT_THAT(notes, Contains(HasSubstr("1 of 6 sides have no beam in YADE")));
}

TEST(YadeGrid, SaysThatWallsTouchNodesOfAnotherMaterial) {
  Scene scene = grid_scene();
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].label = "cord";
  for (GridNode& node : scene.nodes) node.material = 1;
  scene.walls.emplace_back();
  std::vector<std::string> of_the_same, of_others, without_a_wall;

  grids_of(scene, of_the_same);
  scene.materials[1].friction_angle = 0.1;
  grids_of(scene, of_others);
  scene.walls.clear();
  grids_of(scene, without_a_wall);

  const auto touches =
      Contains(HasSubstr("walls touch its nodes, which are of the material \"cord\""));
  EXPECT_THAT(of_the_same, Not(touches));
  EXPECT_THAT(of_others, touches);
  EXPECT_THAT(without_a_wall, Not(touches));
}

}  // namespace
}  // namespace plekton::apps::yade::yade_grid_test
