// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <stdexcept>

namespace plekton::dynamics::scene_test {
namespace {

using contact::MaterialId;

TEST(Scene, IsWrittenDownWithTheMembersThatAreNotAsUsual) {
  const Scene scene{.materials = {{1e7, 0.3, 0.5}}};
  EXPECT_EQ(scene.materials.size(), 1u);
}

TEST(Scene, GivesASphereTheMassAndInertiaOfASphere) {
  Scene scene;

  const geometry::SphereId id = scene.add_sphere(Vec3(1.0, 2.0, 3.0), 0.5, 3000.0, MaterialId{2});

  const double mass = 3000.0 * 4.0 / 3.0 * std::numbers::pi * 0.125;
  EXPECT_EQ(id, geometry::SphereId{0});
  EXPECT_EQ(scene.state.position[0], Vec3(1.0, 2.0, 3.0));
  EXPECT_DOUBLE_EQ(scene.properties.mass[0], mass);
  EXPECT_DOUBLE_EQ(scene.properties.inertia[0], 0.4 * mass * 0.25);
  EXPECT_EQ(scene.sphere_materials[0], MaterialId{2});
}

TEST(Scene, PutsABeamAtRestBetweenTurnedNodes) {
  Scene scene;
  scene.add_node(Vec3::Zero());
  scene.add_node(Vec3(0.0, 2.0, 0.0));
  scene.state.orientation[0] = Quat(Eigen::AngleAxisd(0.7, Vec3::UnitZ()));

  const std::size_t bond =
      scene.add_beam(NodeId{0}, NodeId{1}, circular_section(0.1, 1e6, 0.3), 1e3);

  const BeamBond& beam = scene.bonds[bond];
  EXPECT_DOUBLE_EQ(beam.length, 2.0);
  EXPECT_LT((scene.state.orientation[0] * beam.rest_a * Vec3::UnitX() - Vec3::UnitY()).norm(),
            1e-15);
  EXPECT_LT((scene.state.orientation[1] * beam.rest_b * Vec3::UnitX() - Vec3::UnitY()).norm(),
            1e-15);
}

TEST(Scene, AddsNoRigidBodyOfNodesThatDoNotExist) {
  Scene scene;
  const NodeId node = scene.add_node(Vec3::Zero());

  EXPECT_THAT(
      [&] {
        scene.add_rigid_body(std::array{node, NodeId{7}}, {});
      },
      testing::ThrowsMessage<std::out_of_range>(testing::HasSubstr("add_rigid_body")));
  EXPECT_THROW(scene.add_rigid_body(std::array{NodeId{-1}}, {}), std::out_of_range);
  EXPECT_EQ(scene.state.size(), 1u);
  EXPECT_TRUE(scene.rigid_bodies.empty());
}

}  // namespace
}  // namespace plekton::dynamics::scene_test
