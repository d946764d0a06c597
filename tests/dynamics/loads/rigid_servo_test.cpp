// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/rigid_servo.hpp"

#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/loaded_scene.hpp"
#include "tests/support/named_laws.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace plekton::dynamics {
namespace {

using geometry::NodeId;
using test::problems_of;
using test::simulation_of;
using testing::HasSubstr;

constexpr double kRadius = 0.01;
const contact::MaterialId kMaterial{0};

/// Nine spheres on a floor under a plate that is a little above them.
Scene plate_over_spheres(Held held = Held::rotation) {
  Scene scene;
  scene.materials = {{1e7, 0.3, 0.5}};
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  for (int i = 0; i < 9; ++i)
    scene.add_sphere(Vec3(0.025 * (i % 3 - 1), 0.025 * (i / 3 - 1), kRadius), kRadius, 2000.0,
                     kMaterial);
  const geometry::Mesh mesh = geometry::plane_sheet({0.1, 0.1, 3, 3});
  std::vector<NodeId> nodes;
  for (const Vec3& x : mesh.points)
    nodes.push_back(scene.add_node(x + Vec3(0, 0, 2.0 * kRadius + 0.003), Held::everything));
  for (const auto& [a, b, c] : mesh.facets)
    scene.add_facet(nodes[index_of(a)], nodes[index_of(b)], nodes[index_of(c)], 0.002, kMaterial);
  scene.add_rigid_body(nodes, {0.5, Vec3(0, 0, 2.0 * kRadius + 0.003), 1e-3 * Mat3::Identity()},
                       held);
  BodyServo servo;
  servo.force = 90.0;
  servo.largest_speed = 0.05;
  scene.loads.body_servos.push_back(servo);
  return scene;
}

// The plate comes down 1 mm, sets down on all nine at once, and the error shrinks by a tenth in each
// step.
TEST(RigidServo, PressesWithTheForceThatIsWanted) {
  Scene scene = plate_over_spheres();
  const std::size_t node = index_of(scene.rigid_bodies[0].node);
  auto simulation = simulation_of(std::move(scene), 2e-6, Vec3(0, 0, -9.81));

  while (simulation.step_until(0.1)) {
  }

  EXPECT_NEAR(simulation.rigid_bodies().gathered_force(0).z(), 90.0, 0.09);
  EXPECT_NEAR(simulation.plane_reaction(0).force.z(), -(90.0 + 9.81 * 9 * 2000.0 * 4.18879e-6),
              0.2);
  EXPECT_LT(simulation.state().velocity[node].norm(), 1e-3);
  EXPECT_LT(simulation.energy().closure(), 0.02);
}

// With dashpots as of a restitution of 0.1 a plate that followed what it feels of them would swing
// from step to step.
TEST(RigidServo, PressesWithoutHammeringOnStronglyDampedSpheres) {
  const double ratio = contact::damping_ratio(contact::SpringKind::hertz, 0.1);
  const auto model = contact::any_law({}, test::with<contact::HertzMindlin>({}, {}, {ratio}));
  Scene scene = plate_over_spheres();
  test::LoadedSimulation simulation(std::move(scene), {}, model);
  double largest = 0.0;

  while (simulation.step_until(0.15))
    largest = std::max(largest, simulation.rigid_bodies().gathered_force(0).z());

  EXPECT_NEAR(simulation.rigid_bodies().gathered_force(0).z(), 90.0, 0.9);
  EXPECT_LT(largest, 2.0 * 90.0);
  EXPECT_LT(simulation.energy().closure(), 0.02);
}

// Pressed at one side of what bears it, a plate that may tilt does.
TEST(RigidServo, LeavesATiltFree) {
  Scene scene = plate_over_spheres(Held::about_z);
  for (std::size_t i = 0; i < 9; ++i) scene.state.position[i].x() -= 0.02;
  const std::size_t node = index_of(scene.rigid_bodies[0].node);
  auto simulation = simulation_of(std::move(scene), 2e-6);

  while (simulation.step_until(0.06)) {
  }

  const Vec3 up = simulation.state().orientation[node] * Vec3::UnitZ();
  EXPECT_GT(up.head<2>().norm(), 1e-3);
}

TEST(RigidServo, IsRefusedOnABodyThatIsNotThereOrHeld) {
  Scene scene = plate_over_spheres(Held::along_z);
  EXPECT_THAT(problems_of(scene), HasSubstr("held or moved along that axis already"));
  scene.loads.body_servos[0].body = 3;
  EXPECT_THAT(problems_of(scene), HasSubstr("there is no rigid body 3, only 1 rigid bodies"));
}

}  // namespace
}  // namespace plekton::dynamics
