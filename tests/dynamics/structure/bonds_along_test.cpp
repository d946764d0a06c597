// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/bonds_along.hpp"

#include "dynamics/model/scene.hpp"
#include "dynamics/structure/beam_bonds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plekton::dynamics::bonds_along_test {
namespace {

TEST(BondsAlong, AreFoundByTheirNodesAndPreferredIfTheyHold) {
  Scene scene;
  for (int i = 0; i < 4; ++i) scene.add_node(Vec3(i, 0.0, 0.0));
  const BeamSection section = circular_section(0.01, 1e7, 0.3);
  scene.add_beam(NodeId{2}, NodeId{1}, section, 1000.0);
  scene.add_beam(NodeId{0}, NodeId{1}, section, 1000.0);
  scene.add_beam(NodeId{1}, NodeId{2}, section, 1000.0);
  for (int i = 0; i < 3; ++i)
    scene.add_cylinder(NodeId{i + 1}, NodeId{i}, 0.01, contact::MaterialId{0});
  BeamBonds bonds(scene.bonds, scene.state.size());

  EXPECT_THAT(bonds_along(scene.elements.cylinders, bonds), testing::ElementsAre(1, 0, kNoBond));
  bonds.break_bond(0);
  EXPECT_THAT(bonds_along(scene.elements.cylinders, bonds), testing::ElementsAre(1, 2, kNoBond));
  bonds.break_bond(2);
  EXPECT_THAT(bonds_along(scene.elements.cylinders, bonds), testing::ElementsAre(1, 0, kNoBond));
}

}  // namespace
}  // namespace plekton::dynamics::bonds_along_test
