// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/acted_on.hpp"

#include <gtest/gtest.h>

#include <array>

namespace plekton::dynamics::acted_on_test {
namespace {

/// Spheres in a row, nodes 0 to 19, then a facet on nodes 20 to 22.
Scene row_of_spheres() {
  Scene scene;
  scene.materials.emplace_back();
  for (int i = 0; i < 20; ++i) scene.add_sphere(Vec3(i, 0, 0), 0.4, 1000.0, contact::MaterialId{0});
  std::array<NodeId, 3> nodes{};
  for (int i = 0; i < 3; ++i)
    nodes[static_cast<std::size_t>(i)] = scene.add_node(Vec3(i % 2, i / 2, -5));
  scene.add_facet(nodes[0], nodes[1], nodes[2], 0.1, contact::MaterialId{0});
  return scene;
}

TEST(ActedOn, AreNoNodesOfSpheresThatOnlyTouch) {
  const Scene scene = row_of_spheres();
  EXPECT_EQ(acted_on(scene), std::vector<std::uint8_t>(scene.state.size(), 0));
}

TEST(ActedOn, AreNodesUnderLoadsAndTies) {
  Scene scene = row_of_spheres();
  scene.loads.motions.emplace_back().nodes = {NodeId{1}};
  scene.loads.forces.emplace_back().nodes = {NodeId{3}, NodeId{4}};
  scene.loads.ground_springs.emplace_back().nodes = {NodeId{6}};
  scene.loads.mass_damping.emplace_back().nodes = {NodeId{8}};
  scene.loads.pressures.emplace_back().facets = {geometry::FaceId{0}};
  scene.ties.push_back({.node = NodeId{10}, .to = material_point(NodeId{11})});
  scene.cables.emplace_back().nodes = {NodeId{13}, NodeId{14}};

  std::vector<std::uint8_t> expected(scene.state.size(), 0);
  for (const std::size_t node :
       std::initializer_list<std::size_t>{1, 3, 4, 6, 8, 10, 11, 13, 14, 20, 21, 22})
    expected[node] = 1;
  EXPECT_EQ(acted_on(scene), expected);
}

TEST(ActedOn, AreNodesOfBondsSheetsAndRigidBodies) {
  Scene scene = row_of_spheres();
  scene.bonds.emplace_back().nodes = {NodeId{0}, NodeId{2}};
  scene.sheet_facets.emplace_back().nodes = {NodeId{20}, NodeId{21}, NodeId{22}};
  scene.rigid_bodies.push_back(
      {.node = NodeId{5}, .nodes = {NodeId{7}, NodeId{9}}, .moments = Vec3::Zero()});

  std::vector<std::uint8_t> expected(scene.state.size(), 0);
  for (const std::size_t node : std::initializer_list<std::size_t>{0, 2, 5, 7, 9, 20, 21, 22})
    expected[node] = 1;
  EXPECT_EQ(acted_on(scene), expected);
}

}  // namespace
}  // namespace plekton::dynamics::acted_on_test
