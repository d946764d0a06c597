// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/rigid_servo.hpp"

#include "contact/models.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/loaded_scene.hpp"
#include "tests/support/named_laws.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace plekton::dynamics::rigid_servo_test {
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

/// A ball of 1 kg that lies on a floor with its weight, held along it.
Scene driven_ball(BodyServo servo) {
  constexpr double kModulus = 1e7, kBall = 0.05;
  Scene scene;
  scene.materials = {{kModulus, 0.3, 0.36}};
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  const Vec3 centre(0.0, 0.0, kBall - 9.81 / (kModulus * kBall));  // stiffness E R
  scene.add_sphere(centre, kBall, 2000.0, kMaterial);
  scene.add_rigid_body(std::vector{NodeId{0}}, {1.0, centre, 1e-3 * Mat3::Identity()},
                       Held::along_x | Held::along_y);
  scene.loads.body_servos.push_back(servo);
  return scene;
}

// All of its translation was prescribed, and what is held did not touch planes: it went through.
TEST(RigidServo, PressesOnAPlaneWhereTheOtherAxesAreHeld) {
  Scene scene = plate_over_spheres(Held::along_x | Held::along_y | Held::rotation);
  for (std::size_t i = 0; i < 9; ++i) scene.state.position[i].x() += 1.0;
  auto simulation = simulation_of(std::move(scene), 2e-6);

  while (simulation.step_until(0.5)) {
  }

  EXPECT_NEAR(simulation.plane_reaction(0).force.z(), -90.0, 0.09);
}

// The floor drags the rim of the ball, not its middle, which does not move: the servo took its
// torque for one that nothing holds, and swung at its largest speed.
TEST(TorqueServo, BearsWhatAPlaneDragsOnARoundBody) {
  BodyServo servo;
  servo.torque = 0.05;
  servo.axis = 1;
  servo.largest_speed = 100.0;
  Scene scene = driven_ball(servo);
  const std::size_t node = index_of(scene.rigid_bodies[0].node);
  auto simulation = simulation_of(std::move(scene), 2e-6, Vec3(0.0, 0.0, -9.81));
  double fastest = 0.0;
  while (simulation.step_until(0.2)) {
    if (simulation.time() < 0.1) continue;
    fastest = std::max(fastest, std::abs(simulation.state().angular_velocity[node].y()));
  }

  EXPECT_NEAR(std::abs(simulation.gathered_torque(0).y()), 0.05, 1e-3 * 0.05);
  EXPECT_LT(fastest, 1.0);
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

/// A blade that stands on edge, and turns about z through its middle against two spheres, each
/// before a wall.
/// @param heights  m, of the spheres, that at +x and that at -x
Scene blade_between_spheres(Held held, const std::array<double, 2>& heights = {0.0, 0.0}) {
  constexpr double kHalf = 0.002;  // m, thickness
  constexpr double kLever = 0.04;  // m
  Scene scene;
  scene.materials = {{1e7, 0.3, 0.5}};
  for (int i = 0; i < 2; ++i) {
    const double side = i == 0 ? 1.0 : -1.0;
    scene.add_sphere(
        Vec3(side * kLever, side * (kHalf + kRadius + 1e-4), heights[static_cast<std::size_t>(i)]),
        kRadius, 2000.0, kMaterial);
    scene.planes.push_back({Vec3(0, side * (kHalf + 2.0 * kRadius + 2e-4), 0),
                            -side * Vec3::UnitY(), Vec3::Zero(), kMaterial});
  }
  const geometry::Mesh mesh = geometry::plane_sheet({0.12, 0.06, 4, 2});
  std::vector<NodeId> nodes;
  for (const Vec3& x : mesh.points)
    nodes.push_back(scene.add_node(Vec3(x.x(), 0.0, x.y()), Held::everything));
  for (const auto& [a, b, c] : mesh.facets)
    scene.add_facet(nodes[index_of(a)], nodes[index_of(b)], nodes[index_of(c)], kHalf, kMaterial);
  scene.add_rigid_body(nodes, {0.5, Vec3::Zero(), 1e-3 * Mat3::Identity()}, held);
  BodyServo servo;
  servo.torque = 0.4;
  servo.towards = 1.0;
  servo.largest_speed = 1.0;
  scene.loads.body_servos.push_back(servo);
  return scene;
}

constexpr Held kOnAPivot = Held::translation | Held::about_x | Held::about_y;

// 0.4 N m at levers of 40 mm are 5 N on each.
TEST(TorqueServo, TurnsABodyUntilItsContactsBearTheTorque) {
  auto simulation = simulation_of(blade_between_spheres(kOnAPivot), 2e-6);
  double largest = 0.0;
  while (simulation.step_until(0.1))
    largest = std::max(largest, -simulation.gathered_torque(0).z());

  EXPECT_NEAR(simulation.gathered_torque(0).z(), -0.4, 1e-3 * 0.4);
  for (const std::size_t wall : {0U, 1U})
    EXPECT_NEAR(std::abs(simulation.plane_reaction(wall).force.y()), 5.0, 0.02 * 5.0);
  EXPECT_LT(largest, 2.0 * 0.4);
  EXPECT_LT(simulation.energy().closure(), 0.02);
}

TEST(TorqueServo, FollowsATorqueThatIsSetWhileItRuns) {
  auto simulation = simulation_of(blade_between_spheres(kOnAPivot), 2e-6);
  while (simulation.step_until(0.05)) {
  }
  simulation.set_body_servo(0, 0.6);
  while (simulation.step_until(0.1)) {
  }
  EXPECT_NEAR(simulation.gathered_torque(0).z(), -0.6, 1e-3 * 0.6);
  EXPECT_THROW(simulation.set_body_servo(0, 0.0), std::invalid_argument);
  EXPECT_THROW(simulation.set_body_servo(0, 0.5, 1.0), std::invalid_argument);
}

// Spheres above and below the middle push the blade over, about x, which nothing holds.
TEST(TorqueServo, LeavesATiltFree) {
  Scene scene = blade_between_spheres(Held::translation, {0.01, -0.01});
  const std::size_t node = index_of(scene.rigid_bodies[0].node);
  auto simulation = simulation_of(std::move(scene), 2e-6);

  while (simulation.step_until(0.02)) {
  }

  const Vec3 up = simulation.state().orientation[node] * Vec3::UnitZ();
  EXPECT_GT(up.head<2>().norm(), 1e-3);
}

// What touches nothing is turned as fast as the servo may while it wants a torque, and stops then:
// about the other axes it is sped up and slowed down, also at these moments.
TEST(TorqueServo, KeepsTheEnergyBalanceOfABodyThatIsFreeAboutTheOtherAxes) {
  Scene scene = blade_between_spheres(Held::translation);
  scene.planes.clear();
  for (std::size_t sphere = 0; sphere < 2; ++sphere) scene.state.position[sphere].y() *= 50.0;
  const std::size_t node = index_of(scene.rigid_bodies[0].node);
  scene.state.angular_velocity[node] = Vec3(3.0, 5.0, 0.0);
  scene.rigid_bodies[0].moments = Vec3(1e-3, 2e-3, 2.5e-3);
  scene.loads.body_servos[0].largest_speed = 7.0;
  scene.loads.body_servos[0].factor = TimeTable({{0.1, 0.0}, {0.2, 1.0}, {0.5, 1.0}, {0.6, 0.0}});
  auto simulation = simulation_of(std::move(scene), 1e-4);
  double worst = 0.0, most = 0.0;

  while (simulation.step_until(1.0)) {
    const Energy energy = simulation.energy();
    worst = std::max(worst, energy.closure());
    most = std::max(most, std::abs(energy.external_work) / energy.initial);
  }

  EXPECT_GT(most, 0.1);
  EXPECT_LT(worst, 1e-6);
}

// A plate that is pressed on a bed of held spheres bears a torque by friction alone, of at most
// 0.5 * 90 N * 27 mm.
TEST(TorqueServo, ReachesATorqueThatFrictionBears) {
  Scene scene = plate_over_spheres(Held::along_x | Held::along_y | Held::about_x | Held::about_y);
  for (std::size_t i = 0; i < 9; ++i) scene.properties.held[i] = Held::everything;
  BodyServo turn;
  turn.torque = 0.5;
  turn.largest_speed = 1.0;
  turn.factor = TimeTable({{0.1, 0.0}, {0.12, 1.0}});
  scene.loads.body_servos.push_back(turn);
  auto simulation = simulation_of(std::move(scene), 2e-6);

  while (simulation.step_until(0.2)) {
  }

  EXPECT_NEAR(simulation.gathered_force(0).z(), 90.0, 0.09);
  EXPECT_NEAR(simulation.gathered_torque(0).z(), 0.5, 1e-3 * 0.5);
}

TEST(TorqueServo, IsRefusedWithAForceOrWhereTheBodyIsHeld) {
  Scene scene = blade_between_spheres(Held::everything);
  EXPECT_THAT(problems_of(scene), HasSubstr("held or turned about that axis already"));
  scene = blade_between_spheres(kOnAPivot);
  EXPECT_EQ(problems_of(scene), "");
  scene.loads.body_servos[0].force = 1.0;
  EXPECT_THAT(problems_of(scene), HasSubstr("has a torque, and a force or pressure too"));
  scene.loads.body_servos[0].force = scene.loads.body_servos[0].torque = 0.0;
  EXPECT_THAT(problems_of(scene), HasSubstr("has no target"));
}

TEST(RigidServo, IsRefusedBetweenPlanesThatBoundNoArea) {
  Scene scene = plate_over_spheres();
  for (const Vec3& normal : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())})
    for (const double side : {1.0, -1.0})
      scene.planes.push_back({-side * normal, side * normal, Vec3::Zero(), kMaterial});
  scene.loads.body_servos[0].between = {{1, 2}, {3, 4}};
  EXPECT_EQ(problems_of(scene), "");

  scene.loads.body_servos[0].between = {{1, 2}};
  EXPECT_THAT(problems_of(scene), HasSubstr("bound no area across its direction"));
  scene.loads.body_servos[0].between = {{1, 2}, {3, 4}};
  scene.loads.body_servos[0].axis = 0;
  EXPECT_THAT(problems_of(scene), HasSubstr("bound no area across its direction"));
}

TEST(RigidServo, IsRefusedOnABodyThatIsNotThereOrHeld) {
  Scene scene = plate_over_spheres(Held::along_z);
  EXPECT_THAT(problems_of(scene), HasSubstr("held or moved along that axis already"));
  scene.loads.body_servos[0].body = 3;
  EXPECT_THAT(problems_of(scene), HasSubstr("there is no rigid body 3, only 1 rigid bodies"));
}

}  // namespace
}  // namespace plekton::dynamics::rigid_servo_test
