// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/own_force.hpp"

#include "dynamics/simulation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace plekton::dynamics::own_force_test {
namespace {

/// Balls of 4 kg and radius 0.1 m in a row, 1 m apart.
Scene row_of_balls(int count) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.3}};
  for (int i = 0; i < count; ++i) {
    const double density = 4.0 / (4.0 / 3.0 * 3.14159265358979324 * 1e-3);
    scene.add_sphere(Vec3(i, 0, 0), 0.1, density, contact::MaterialId{0});
  }
  return scene;
}

SimulationOptions steps_of(double time_step) {
  SimulationOptions options;
  options.time_step = time_step;
  return options;
}

TEST(OwnForce, MovesItsNodesAndNoOthers) {
  Simulation simulation(row_of_balls(3), steps_of(1e-3));
  simulation.add_force({NodeId{2}, NodeId{0}}, [](double, const NodeState&, auto forces) {
    forces[0] = {Vec3(8, 0, 0)};           // on node 2
    forces[1].torque = Vec3(0, 0, 0.016);  // on node 0, of moment of inertia 0.016 kg m²
  });
  for (int i = 0; i < 1000; ++i) simulation.step();
  // From rest by 2 m/s² for 1 s; the leapfrog is exact for it.
  EXPECT_NEAR(simulation.state().position[2][0], 2.0 + 1.0, 1e-12);
  EXPECT_NEAR(simulation.state().angular_velocity[0][2], 1.0, 2e-3);
  EXPECT_EQ(simulation.state().position[1], Vec3(1, 0, 0));
  // What a load that is there at once gives in the first half step counts as there at the start.
  const Energy energy = simulation.energy();
  EXPECT_NEAR(energy.initial + energy.external_work, energy.kinetic, 1e-12 * energy.kinetic);
}

/// A spring of 100 N/m to the origin: the ball of 4 kg swings with 5 rad/s.
TEST(OwnForce, OfASpringSwingsAndClosesTheBooks) {
  Scene scene = row_of_balls(1);
  scene.state.position[0] = Vec3(0, 0.7, 0);
  Simulation simulation(std::move(scene), steps_of(1e-3));
  double last_time = -1.0;
  simulation.add_force({NodeId{0}}, [&](double time, const NodeState& state, auto forces) {
    EXPECT_GT(time, last_time);  // once a step
    last_time = time;
    forces[0].force = -100.0 * state.position[0];
  });
  const double swing = 2.0 * 3.14159265358979324 / 5.0;
  while (simulation.step_until(10.0 * swing)) {
  }
  // The leapfrog's frequency is off by (omega dt)² / 24, 1e-6.
  EXPECT_NEAR(simulation.state().position[0][1], 0.7, 1e-4);
  const Energy energy = simulation.energy();
  EXPECT_NEAR(energy.initial + energy.external_work, energy.kinetic,
              1e-4 * 0.5 * 100.0 * 0.7 * 0.7);
}

TEST(OwnForce, RefusesNodesThatAreNotThereTwiceOrOfARigidBody) {
  Scene scene = row_of_balls(3);
  MassProperties mass;
  mass.mass = 1.0;
  mass.centre = Vec3(2, 0, 0);
  mass.inertia = Mat3::Identity();
  scene.add_rigid_body(std::array{NodeId{2}}, mass);
  Simulation simulation(std::move(scene), steps_of(1e-3));
  const OwnForce nothing = [](double, const NodeState&, auto) {};
  EXPECT_THROW(simulation.add_force({NodeId{7}}, nothing), std::out_of_range);
  EXPECT_THROW(simulation.add_force({NodeId{0}, NodeId{0}}, nothing), std::invalid_argument);
  EXPECT_THROW(simulation.add_force({NodeId{2}}, nothing), std::invalid_argument);
  EXPECT_THROW(simulation.add_force({NodeId{0}}, {}), std::invalid_argument);
}

TEST(Loads, AreChangedWhileItRuns) {
  Scene scene = row_of_balls(2);
  scene.loads.forces.emplace_back().nodes = {NodeId{1}};
  scene.loads.forces[0].force = Vec3(4, 0, 0);
  Simulation simulation(std::move(scene), steps_of(1e-3));
  for (int i = 0; i < 500; ++i) simulation.step();
  simulation.set_force(0, Vec3(-4, 0, 0));
  for (int i = 0; i < 500; ++i) simulation.step();
  // Velocities are half a step ahead.
  EXPECT_NEAR(simulation.state().velocity[1][0], -0.0005, 1e-12);
  EXPECT_THROW(simulation.set_force(1, Vec3::Zero()), std::out_of_range);
  EXPECT_THROW(simulation.set_pressure(0, 1.0), std::out_of_range);
  EXPECT_THROW(simulation.set_force(0, Vec3(0, std::nan(""), 0)), std::invalid_argument);
}

/// A facet of sides of 1 m, alike at its nodes, under a pressure along z.
/// @param held  of its nodes
Scene pressed_facet(double pressure, Held held = Held::nothing) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.5}};
  for (const double angle : {0.0, 2.0, 4.0}) {
    const double turn = angle * 3.14159265358979324 / 3.0;
    scene.add_node(Vec3(std::cos(turn), std::sin(turn), 0.0) / std::sqrt(3.0), held);
  }
  scene.add_facet(NodeId{0}, NodeId{1}, NodeId{2}, 0.01, contact::MaterialId{0});
  for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2), std::pair(2, 0)})
    scene.add_beam(NodeId{a}, NodeId{b}, circular_section(0.01, 1e9, 0.3), 1000.0);
  scene.loads.pressures.emplace_back().facets = {geometry::FaceId{0}};
  scene.loads.pressures[0].pressure = pressure;
  return scene;
}

TEST(Loads, ArePressuresThatAreTurnedRoundWhileItRuns) {
  Simulation simulation(pressed_facet(2.0), steps_of(1e-5));
  for (int i = 0; i < 500; ++i) simulation.step();
  const double way = simulation.state().velocity[0].z();
  // Half a step ahead: 499.5 steps of p A / m, A = sqrt(3) / 4 m², m that of three beams.
  const double mass = 3.0 * 3.14159265358979324 * 1e-4 * 1000.0;
  EXPECT_NEAR(way, 499.5e-5 * 2.0 * std::sqrt(3.0) / 4.0 / mass, 1e-9 * way);
  simulation.set_pressure(0, -2.0);
  for (int i = 0; i < 500; ++i) simulation.step();
  EXPECT_NEAR(simulation.state().velocity[0].z(), -0.5 / 499.5 * way, 1e-9 * way);
  EXPECT_THROW(simulation.set_pressure(0, std::nan("")), std::invalid_argument);
}

TEST(Loads, ShortenAChosenStepAsSoonAsAPressureNeedsIt) {
  Simulation simulation(pressed_facet(1.0, Held::along_z), {});
  for (int i = 0; i < 10; ++i) simulation.step();
  const double before = simulation.time_step();
  simulation.set_pressure(0, 1e9);
  simulation.step();
  EXPECT_LT(simulation.time_step(), 0.5 * before);
  EXPECT_LE(simulation.time_step(),
            0.8 * Simulation(pressed_facet(1e9, Held::along_z), {}).critical_step().dt);
}

}  // namespace
}  // namespace plekton::dynamics::own_force_test
