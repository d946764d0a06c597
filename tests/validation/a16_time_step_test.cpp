// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"
#include "tests/support/beam_structure.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

/// A16: the step at which the leapfrog becomes unstable, by running just below and just above it,
/// against 2 / omega_max of the lumped Euler-Bernoulli matrix; and what the estimates say of it.
namespace plekton::test::a16_time_step_test {
namespace {

using dynamics::Simulation;

struct Chain {
  double radius;    // m
  double critical;  // s, 2 / omega_max
};
// 10 bonds of 0.1 m, E = 1e8 Pa, nu = 0.3, 1000 kg/m³, no node held.
constexpr std::array<Chain, 4> kChains{
    {{0.05, 2.168e-4}, {0.02, 2.300e-4}, {0.005, 2.309e-4}, {0.1, 1.628e-4}}};

Simulation chain_at_rest(double radius) {
  dynamics::SimulationOptions options;
  options.motion.gravity = Vec3::Zero();
  return Simulation(chain(10, 1.0, dynamics::circular_section(radius, 1e8, 0.3)), options);
}

/// Whether motions of 1 um/s at random are still below 100 um/s after 6000 steps.
bool is_stable(double radius, double dt) {
  Scene scene = chain(10, 1.0, dynamics::circular_section(radius, 1e8, 0.3));
  Random random(2);
  for (std::size_t i = 0; i < scene.state.size(); ++i) {
    scene.state.velocity[i] = random.in_cube(1e-6);
    scene.state.angular_velocity[i] = random.in_cube(1e-6 / radius);
  }
  dynamics::SimulationOptions options;
  options.motion.gravity = Vec3::Zero();
  Simulation simulation(std::move(scene), options);
  simulation.set_time_step(dt);
  double fastest = 0.0;
  for (int i = 0; i < 6000 && fastest < 1e-4; ++i) {
    simulation.step();
    fastest = 0.0;
    for (std::size_t n = 0; n < simulation.state().size(); ++n) {
      fastest = std::max(fastest, simulation.state().velocity[n].norm() +
                                      radius * simulation.state().angular_velocity[n].norm());
    }
  }
  return fastest < 1e-4;
}

TEST(A16TimeStep, ChainsBecomeUnstableAtTheStepOfTheirHighestFrequency) {
  for (const auto& [radius, critical] : kChains) {
    EXPECT_TRUE(is_stable(radius, 0.99 * critical)) << radius;
    EXPECT_FALSE(is_stable(radius, 1.01 * critical)) << radius;
  }
}

TEST(A16TimeStep, TheExactStepOfChainsIsThat) {
  for (const auto& [radius, critical] : kChains)
    EXPECT_NEAR(chain_at_rest(radius).exact_critical_step().dt, critical, 1e-3 * critical);
}

TEST(A16TimeStep, TheEstimateOfChainsIsBetweenHalfAndAllOfIt) {
  for (const auto& [radius, critical] : kChains) {
    const double estimate = chain_at_rest(radius).critical_step().dt;

    EXPECT_LE(estimate, critical * (1.0 + 0.5e-3));  // the reference has four digits
    EXPECT_GE(estimate, 0.5 * critical);
  }
}

// A heavy ball on the middle of a light cylinder: 2.65e-5 s = 2 / sqrt(k (1/M + 1/(2 m))). YADE's
// stepper gives 6.0e-4 s, since it counts the contact on a body without mass (its defect D12).
TEST(A16TimeStep, AContactOnACylinderIsCountedOnItsNodes) {
  constexpr contact::MaterialId kMaterial{0};
  Scene scene;
  scene.materials = {{1e9, 0.3, 0.5}};
  const NodeId a = scene.add_node(Vec3(-0.2, 0.0, 0.0));
  const NodeId b = scene.add_node(Vec3(0.2, 0.0, 0.0));
  scene.add_cylinder(a, b, 0.02, kMaterial);
  scene.add_beam(a, b, dynamics::circular_section(0.02, 1e6, 0.3), 10.0);
  scene.add_sphere(Vec3(0.0, 0.0, 0.0699), 0.05, 1e4, kMaterial);
  // The beam itself is clamped against turning, as in the formula.
  scene.properties.held[0] = scene.properties.held[1] = dynamics::Held::rotation;
  dynamics::SimulationOptions options;
  const Simulation simulation(std::move(scene), options);

  EXPECT_LE(simulation.critical_step().dt, 2.65e-5);
  EXPECT_GE(simulation.critical_step().dt, 0.5 * 2.65e-5);
  EXPECT_EQ(simulation.exact_critical_step().contacts, 1U);
  EXPECT_NEAR(simulation.exact_critical_step().dt, 2.6515e-5, 1e-3 * 2.6515e-5);
}

}  // namespace
}  // namespace plekton::test::a16_time_step_test
