// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"

#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/membrane.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace plekton::dynamics::simulation_test {
namespace {

using geometry::NodeId;

const Vec3 kGravity(0.0, 0.0, -9.81);

/// A sheet of 0.4 m held at its rim, of beams of 10 MPa, and a ball above it.
Scene ball_over_sheet(double sheet_radius, double ball_radius, double contact_modulus) {
  Scene scene;
  scene.materials = {{contact_modulus, 0.3, 0.5}};
  const contact::MaterialId material{0};
  const auto sheet = geometry::make_membrane(geometry::plane_sheet({0.4, 0.4, 8, 8}),
                                             {.thickness = 2.0 * sheet_radius});
  for (const Vec3& x : sheet.nodes) {
    scene.add_node(x, x.cwiseAbs().maxCoeff() > 0.199 ? Held::everything : Held::nothing);
  }
  for (const auto& facet : sheet.facets) {
    scene.add_facet(facet.nodes[0], facet.nodes[1], facet.nodes[2], facet.radius, material);
  }
  const BeamSection section = circular_section(sheet_radius, 1e7, 0.3);
  for (const auto& [a, b] : sheet.edges) scene.add_beam(a, b, section, 300.0);
  const double height = ball_radius + sheet_radius + 0.005;
  scene.add_sphere(Vec3(0.01, 0.02, height), ball_radius, 2650.0, material);
  scene.state.velocity.back() = Vec3(0.0, 0.0, -1.0);
  return scene;
}

TEST(Simulation, ChoosesAStepThatStaysSafeWhenAStiffSphereLandsOnALightSheet) {
  Simulation simulation(ball_over_sheet(0.001, 0.03, 1e9), {.motion = {.gravity = kGravity}});
  double largest = 0.0;

  while (simulation.time() < 0.05) {
    simulation.step();
    largest = std::max(largest, simulation.time_step() / simulation.present_critical_step().dt);
  }

  EXPECT_LE(largest, kLargestStep);
  EXPECT_GT(simulation.largest_overlap_ratio(), 0.0);  // it has landed
  EXPECT_LT(simulation.energy().closure(), 5e-3);
}

TEST(Simulation, EndsAtTheTimeThatItIsAskedForAndGoesOnWithItsOwnStep) {
  Simulation simulation(ball_over_sheet(0.002, 0.03, 5e6), {.motion = {.gravity = kGravity}});
  const double step = simulation.time_step();

  while (simulation.step_until(2.3 * step)) {
  }

  EXPECT_EQ(simulation.steps(), 3);
  EXPECT_NEAR(simulation.time(), 2.3 * step, 1e-15 * step);
  EXPECT_EQ(simulation.time_step(), step);
}

TEST(Simulation, GoesToATimeInEqualSteps) {
  Simulation simulation(ball_over_sheet(0.002, 0.03, 5e6), {.motion = {.gravity = kGravity}});
  const double step = simulation.time_step();

  for (int i = 1; simulation.step_until(8.1 * step); ++i)
    EXPECT_NEAR(simulation.time(), 0.9 * i * step, 1e-13 * step);

  EXPECT_EQ(simulation.steps(), 9);
}

TEST(Simulation, LeavesOutTheRestThatRoundingLeavesBeforeAnEnd) {
  Simulation simulation(ball_over_sheet(0.002, 0.03, 5e6), {.motion = {.gravity = kGravity}});
  const double step = simulation.time_step();

  EXPECT_TRUE(simulation.step_until(1.0001 * step));
  EXPECT_EQ(simulation.time(), step);
  EXPECT_FALSE(simulation.step_until(1.0001 * step));
}

// A mass on a spring, omega dt = 1.8e-3: kinetic energy is read in the middle of two drifts, which
// differ by up to a step, so up to omega dt / 2 beside the moment of the forces.
TEST(Simulation, KeepsItsEnergyThroughAShorterStep) {
  Scene scene;
  scene.materials = {{5e6, 0.3, 0.5}};
  scene.add_sphere(Vec3::Zero(), 0.03, 2650.0, contact::MaterialId{0});
  scene.loads.ground_springs.push_back({{NodeId{0}}, Vec3(1e4, 1e4, 1e4)});
  scene.state.velocity[0] = Vec3(0.0, 0.0, -1.0);
  Simulation simulation(scene, {.time_step = 1e-5, .motion = {}});

  for (int i = 1; i <= 20; ++i) {
    while (simulation.step_until(10.37e-5 * i)) {
    }
  }

  EXPECT_LT(simulation.energy().closure(), 1e-3);
}

TEST(Simulation, RefusesAStepAboveTheCriticalOneAndNamesIt) {
  try {
    Simulation simulation(ball_over_sheet(0.002, 0.03, 5e6), {.time_step = 1.0, .motion = {}});
    FAIL() << "a step of 1 s was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("time step 1 s: the critical time step of this"));
  }
}

TEST(Simulation, RefusesOptionsThatCannotBeAndNamesAllOfThem) {
  const SimulationOptions options = {
      .time_step = -1.0,
      .motion = {.gravity = Vec3(0.0, 0.0, std::nan("")), .damping = 1.0},
      .skin = -0.5};

  EXPECT_THAT([&] { Simulation(ball_over_sheet(0.002, 0.03, 5e6), options); },
              testing::ThrowsMessage<std::invalid_argument>(
                  testing::AllOf(testing::HasSubstr("time step -1 s: must be 0 (choose) or more"),
                                 testing::HasSubstr("numerical damping 1: must be at least 0"),
                                 testing::HasSubstr("skin -0.5 m: must be 0 (choose) or more"),
                                 testing::HasSubstr("gravity is not finite"))));
}

TEST(Simulation, RefusesAStepThatIsNoneWhileItRuns) {
  Simulation simulation(ball_over_sheet(0.002, 0.03, 5e6), {.motion = {.gravity = kGravity}});
  const double step = simulation.time_step();

  for (const double none : {0.0, -1e-6, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(simulation.set_time_step(none), std::invalid_argument) << none;

  EXPECT_EQ(simulation.time_step(), step);
}

TEST(Simulation, KeepsItsEnergyBalanceWhenTheStepIsChanged) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.0}};
  scene.add_sphere(Vec3::Zero(), 0.01, 2650.0, contact::MaterialId{0});
  Simulation simulation(scene, {.time_step = 2e-5, .motion = {.gravity = kGravity}});

  for (int i = 0; i < 1000; ++i) simulation.step();
  const double before = simulation.energy().closure_error();
  simulation.set_time_step(1e-6);
  const double at_once = simulation.energy().closure_error();
  for (int i = 0; i < 1000; ++i) simulation.step();
  const Energy after = simulation.energy();

  // A free fall: the product form of the kinetic energy differs from the true one by m (g dt)² / 8.
  const double tolerance = simulation.properties().mass[0] * std::pow(9.81 * 2e-5, 2);
  EXPECT_NEAR(before, 0.0, tolerance);
  EXPECT_EQ(at_once, before);
  EXPECT_NEAR(after.closure_error(), 0.0, tolerance);
}

TEST(Simulation, FallsAsFarAsAFreeFallFromItsFirstStep) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.0}};
  scene.add_sphere(Vec3::Zero(), 0.01, 2650.0, contact::MaterialId{0});
  Simulation simulation(scene, {.time_step = 1e-5, .motion = {.gravity = kGravity}});

  for (int i = 0; i < 1000; ++i) simulation.step();

  const double t = simulation.time();
  EXPECT_NEAR(simulation.state().position[0].z(), -0.5 * 9.81 * t * t, 1e-15);
}

TEST(Simulation, ThrowsWhereNothingSetsAStepAndNoneIsGiven) {
  Scene scene;
  scene.add_node(Vec3::Zero());
  scene.properties.mass[0] = 1.0;
  scene.properties.inertia[0] = 1.0;

  Simulation simulation(scene, {});

  EXPECT_THROW(simulation.step(), std::logic_error);
}

TEST(Simulation, LetsPointMassesWithoutElementsMoveAsFastAsTheyLike) {
  Scene scene;
  scene.add_node(Vec3::Zero());
  scene.properties.mass[0] = 1.0;
  scene.properties.inertia[0] = 1.0;
  scene.state.velocity[0] = Vec3(1000.0, 0.0, 0.0);
  Simulation simulation(scene, {.time_step = 1.0, .motion = {}});

  simulation.step();

  EXPECT_EQ(simulation.state().position[0].x(), 1000.0);
}

TEST(Simulation, SaysWhereItDivergedWhenANodeMovesFurtherThanItsElementsCanNotice) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.0}};
  scene.add_sphere(Vec3(1.0, 2.0, 3.0), 0.01, 2650.0, contact::MaterialId{0});
  scene.state.velocity[0] = Vec3(1e6, 0.0, 0.0);
  Simulation simulation(scene, {.time_step = 1e-5, .motion = {}});

  try {
    simulation.step();
    FAIL() << "10 m in one step went unnoticed";
  } catch (const Diverged& error) {
    EXPECT_EQ(error.step(), 0);
    EXPECT_EQ(error.node(), NodeId{0});
    EXPECT_THAT(error.what(), testing::HasSubstr("node 0 at (11  2  3) m"));
  }
}

TEST(Simulation, MayBeMadeOfASceneThatWasMovedFromAndFilledAnew) {
  const auto fill = [](Scene& scene) {
    scene.materials = {{1e6, 0.3, 0.0}};
    scene.add_sphere(Vec3(0.0, 0.0, 0.1), 0.01, 2650.0, contact::MaterialId{0});
  };
  Scene scene;
  fill(scene);
  const SimulationOptions options{.time_step = 1e-4, .motion = {.gravity = kGravity}};
  Simulation first(std::move(scene), options);
  fill(scene);
  Simulation second(scene, options);

  first.step();
  second.step();

  EXPECT_EQ(second.state().velocity[0], first.state().velocity[0]);
  EXPECT_LT(second.state().velocity[0].z(), 0.0);
}

TEST(Simulation, RefusesAVelocityThatIsNotFinite) {
  Simulation simulation(ball_over_sheet(0.002, 0.03, 5e6), {});
  const auto node = geometry::id_at<NodeId>(simulation.state().size() - 1);
  const Vec3 none(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);

  EXPECT_THROW(simulation.set_velocity(node, none), std::invalid_argument);
  EXPECT_THROW(simulation.set_velocity(node, Vec3::Zero(), none), std::invalid_argument);
  EXPECT_EQ(simulation.state().velocity.back(), Vec3(0.0, 0.0, -1.0));
}

TEST(Simulation, RefusesAContactModelThatIsNone) {
  EXPECT_THROW(Simulation(Scene{}, {}, contact::ContactModel{}), std::invalid_argument);
}

}  // namespace
}  // namespace plekton::dynamics::simulation_test
