// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/nodal_force.hpp"

#include "tests/support/beam_structure.hpp"
#include "tests/support/loaded_scene.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace plekton::test::nodal_force_test {
namespace {

using dynamics::Held;
using dynamics::NodalForce;
using dynamics::TimeTable;
using testing::HasSubstr;

constexpr double kEps = std::numeric_limits<double>::epsilon();

TEST(NodalForce, AcceleratesByForceOverMassAndTorqueOverInertia) {
  Scene scene;
  NodalForce load;
  load.nodes = {add_lump(scene, Vec3::Zero())};
  load.force = Vec3(4.0, 0.0, -2.0);
  load.torque = Vec3(0.0, 0.05, 0.0);
  scene.loads.forces.push_back(load);
  auto simulation = simulation_of(scene, 0.125);

  for (int i = 0; i < 8; ++i) simulation.step();

  // x = a t² / 2, exact in the leapfrog; v is that of half a step before the end.
  EXPECT_EQ(simulation.state().position[0], Vec3(1.0, 0.0, -0.5));
  EXPECT_NEAR(simulation.state().angular_velocity[0].y(), 0.5 * (1.0 - 0.0625), 16.0 * kEps);
  EXPECT_EQ(simulation.forces().force[0], load.force);
}

TEST(NodalForce, FollowsItsTable) {
  Scene scene;
  NodalForce load;
  load.nodes = {add_lump(scene, Vec3::Zero()), add_lump(scene, Vec3::UnitX())};
  load.force = Vec3(0.0, 10.0, 0.0);
  load.factor = TimeTable({{0.5, 0.0}, {1.0, 1.0}});
  scene.loads.forces.push_back(load);
  auto simulation = simulation_of(scene, 0.25);

  for (const double expected : {0.0, 0.0, 0.0, 5.0, 10.0, 10.0}) {
    simulation.step();
    EXPECT_EQ(simulation.forces().force[0], Vec3(0.0, expected, 0.0));
    EXPECT_EQ(simulation.forces().force[1], Vec3(0.0, expected, 0.0));
  }
}

TEST(NodalForce, DoesTheWorkThatBecomesKineticEnergy) {
  Scene scene;
  NodalForce load;
  load.nodes = {add_lump(scene, Vec3::Zero())};
  load.force = Vec3(4.0, 1.0, -2.0);
  load.torque = Vec3(0.0, 0.05, 0.3);
  load.factor = TimeTable({{0.0, 0.0}, {0.4, -2.0}, {0.9, 3.0}});
  scene.loads.forces.push_back(load);
  auto simulation = simulation_of(scene, 0.01);

  // The leapfrog's kinetic energy changes by the work of the trapezoidal rule, to rounding.
  EXPECT_LT(closure_until(simulation, 1.0), 200.0 * kEps);
  EXPECT_GT(simulation.energy().external_work, 0.05);
}

TEST(NodalForce, OnAHeldNodeDoesNoWorkOnTheRest) {
  Scene scene = chain(4, 0.2, dynamics::circular_section(0.003, 1e7, 0.3));
  dynamics::PrescribedMotion motion;
  motion.nodes = {NodeId{0}};
  motion.held = Held::everything;
  motion.velocity = Vec3(0.0, 0.1, 0.0);
  motion.factor = TimeTable({{0.0, 0.0}, {0.01, 1.0}});
  scene.loads.motions.push_back(motion);
  auto without = simulation_of(scene, 1e-5);
  NodalForce load;
  load.nodes = {NodeId{0}};
  load.force = Vec3(0.0, 1000.0, 0.0);
  scene.loads.forces.push_back(load);
  auto with = simulation_of(scene, 1e-5);

  for (int i = 0; i < 2000; ++i) {
    with.step();
    without.step();
  }

  const double expected = without.energy().external_work;
  // 1000 N over 2 mm are 2 J, done by the force and taken by what holds the node, summed over
  // 2000 steps.
  EXPECT_NEAR(with.energy().external_work, expected, 2000 * kEps * 2.0);
  EXPECT_EQ(with.state().position[3], without.state().position[3]);
}

TEST(NodalForce, IsRefusedIfItIsNotFinite) {
  Scene scene;
  NodalForce load;
  load.nodes = {add_lump(scene, Vec3::Zero())};
  load.torque.y() = std::numeric_limits<double>::quiet_NaN();
  scene.loads.forces.push_back(load);

  EXPECT_THAT(problems_of(scene),
              HasSubstr("nodal force 0: its torque (  0 nan   0) is not finite"));
}

}  // namespace
}  // namespace plekton::test::nodal_force_test
