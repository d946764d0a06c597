// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/motion_step.hpp"

#include "dynamics/simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plekton::dynamics::motion_step_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr contact::MaterialId kMaterial{0};
const Vec3 kGravity(0.0, 0.0, -9.81);

/// A sphere that its contacts allow steps of far more than it takes to cross its radius at speed.
Scene soft_sphere(double radius, const Vec3& velocity) {
  Scene scene;
  scene.materials = {{1e4, 0.3, 0.4}};
  scene.add_sphere(Vec3::Zero(), radius, 2500.0, kMaterial);
  scene.state.velocity[0] = velocity;
  return scene;
}

TEST(LongestStep, CoversATenthOfTheRadiusAtTheSpeedThatGravityLeadsTo) {
  EXPECT_DOUBLE_EQ(longest_step(2.0, 0.0, 0.5), 0.1 * 0.5 / 2.0);
  for (const double speed : {0.0, 1e-6, 1.0, 1e6}) {
    const double dt = longest_step(speed, 9.81, 0.5);

    const double motion = (speed + static_cast<double>(kStepsBetweenLooks) * 9.81 * dt) * dt;
    EXPECT_NEAR(motion, 0.05, 1e-15);  // a few rounding errors of 0.05
  }
}

TEST(LongestStep, IsInfiniteWhereNothingMovesOrNothingCanTouch) {
  EXPECT_EQ(longest_step(0.0, 0.0, 0.5), kInfinity);
  EXPECT_EQ(longest_step(3.0, 9.81, kInfinity), kInfinity);
  EXPECT_EQ(longest_step(3.0, 0.0, kInfinity), kInfinity);
}

TEST(ChosenStep, IsShortenedWhereASphereIsFastAndGrowsAgainWhereItHasSlowedDown) {
  Scene scene = soft_sphere(0.01, Vec3(50.0, 0.0, 0.0));
  Simulation simulation(scene, {.motion = {.gravity = Vec3(-1e4, 0.0, 0.0)}});
  const double stable = kSafety * simulation.critical_step().dt;
  const double at_start = simulation.time_step();

  while (simulation.time() < 4e-3) simulation.step();  // 10 m/s are left

  EXPECT_LT(at_start, 0.1 * stable);
  EXPECT_LE(50.0 * at_start, kLargestMotion * 0.01);
  EXPECT_GT(simulation.time_step(), at_start);
  EXPECT_LE(simulation.motion_ratio(), kLargestMotion);
}

TEST(ChosenStep, KeepsTheMotionInEveryStepOfALongFallBelowATenthOfTheRadius) {
  Simulation simulation(soft_sphere(100.0, Vec3::Zero()), {.motion = {.gravity = kGravity}});
  double largest = 0.0;

  while (simulation.time() < 60.0) {
    simulation.step();
    largest = std::max(largest, simulation.motion_ratio());
  }

  EXPECT_LE(largest, kLargestMotion);
  EXPECT_GT(largest, 0.5 * kLargestMotion);
}

TEST(ChosenStep, FollowsAHeldNodeAsSoonAsItIsMadeToMove) {
  Scene scene = soft_sphere(0.01, Vec3::Zero());
  scene.properties.held[0] = Held::everything;
  scene.add_sphere(Vec3(0.1, 0.0, 0.0), 0.01, 2500.0, kMaterial);
  Simulation simulation(scene, {});

  simulation.set_velocity(geometry::NodeId{0}, Vec3(30.0, 0.0, 0.0));

  EXPECT_LE(simulation.motion_ratio(), kLargestMotion * (1.0 + 1e-15));
}

/// One of two spheres is moved by 1 mm/s until 20 s, by 20 m/s until 20.1 s, and not from then on.
Simulation slow_then_fast() {
  Scene scene = soft_sphere(0.01, Vec3::Zero());
  scene.add_sphere(Vec3(0.1, 0.0, 0.0), 0.01, 2500.0, kMaterial);
  scene.loads.motions = {
      {.nodes = {geometry::NodeId{0}},
       .held = Held::everything,
       .displacement = Vec3(0.0, 0.02, 0.0),
       .factor = TimeTable({{0.0, 0.0}, {20.0, 1.0}, {20.1, 101.0}, {40.0, 101.0}})}};
  return Simulation(scene, {});
}

TEST(ChosenStep, FollowsAPrescribedMotionAsFastAsItIsThenAndNotAtItsFastest) {
  Simulation simulation = slow_then_fast();
  const double stable = kSafety * simulation.critical_step().dt;
  double slow = 0.0, moved = 0.0;

  while (simulation.time() < 19.5) simulation.step();
  slow = simulation.time_step();
  while (simulation.time() < 39.0) {
    simulation.step();
    moved = std::max(moved, simulation.motion_ratio());
  }

  EXPECT_GT(slow, 0.5 * stable);
  EXPECT_GT(simulation.time_step(), 0.5 * stable);
  // A time of 20 s is known to 4e-15 s, in which the node moves by 7e-12 of its radius.
  EXPECT_LE(moved, kLargestMotion + 1e-11);
  EXPECT_GT(moved, 0.5 * kLargestMotion);
}

TEST(ChosenStep, LetsNoFastSphereThroughASheetThatIsHeld) {
  Scene scene = soft_sphere(0.01, Vec3(0.0, 0.0, -20.0));
  scene.materials[0].young_modulus = 1e8;
  scene.state.position[0] = Vec3(0.01, 0.02, 0.05);
  for (const Vec3& corner : {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)}) {
    scene.add_node(corner, Held::everything);
  }
  scene.add_facet(geometry::NodeId{1}, geometry::NodeId{2}, geometry::NodeId{3}, 0.0005, kMaterial);
  Simulation simulation(scene, {});

  while (simulation.time() < 0.01) simulation.step();

  EXPECT_GT(simulation.state().position[0].z(), 0.0);
  EXPECT_NEAR(simulation.state().velocity[0].z(), 20.0, 0.2);  // 1 %, of the moments of contact
}

// Half a turn in a step would end the run.
TEST(ChosenStep, TurnsNoNodeByMoreThanARadian) {
  Scene scene = soft_sphere(0.01, Vec3::Zero());
  scene.state.angular_velocity[0] = Vec3(0.0, 0.0, 1e5);
  Simulation simulation(scene, {});
  simulation.step();

  simulation.step();

  EXPECT_LE(1e5 * simulation.time_step(), 1.0);
  EXPECT_GE(1e5 * simulation.time_step(), 0.5 * (1.0 - 1e-12));
}

TEST(GivenStep, StaysAsGivenHoweverFastASphereIs) {
  const Scene scene = soft_sphere(0.01, Vec3(50.0, 0.0, 0.0));
  Simulation simulation(scene, {.time_step = 1e-4, .motion = {.gravity = kGravity}});

  for (int i = 0; i < 2 * kStepsBetweenLooks; ++i) simulation.step();

  EXPECT_EQ(simulation.time_step(), 1e-4);
  EXPECT_NEAR(simulation.motion_ratio(), 0.5, 0.005);  // gravity adds 0.1 m/s
}

/// A bar that flies by half its radius in a step.
Scene fast_bar() {
  Scene scene;
  scene.materials = {{1e4, 0.3, 0.4}};
  const geometry::NodeId a = scene.add_node(Vec3::Zero()), b = scene.add_node(Vec3(1.0, 0.0, 0.0));
  scene.add_cylinder(a, b, 0.01, kMaterial);
  for (const std::size_t node : {0U, 1U}) {
    scene.properties.mass[node] = scene.properties.inertia[node] = 1.0;
    scene.state.velocity[node] = Vec3(0.0, 50.0, 0.0);
  }
  return scene;
}

TEST(MotionRatio, IsOfWhatMayTouch) {
  const SimulationOptions alone{.time_step = 1e-4, .motion = {}, .self_contact = false};
  EXPECT_EQ(Simulation(fast_bar(), alone).motion_ratio(), 0.0);

  EXPECT_NEAR(Simulation(fast_bar(), {.time_step = 1e-4, .motion = {}}).motion_ratio(), 0.5, 1e-15);
  Scene with_floor = fast_bar();
  with_floor.planes.push_back({Vec3(0.0, 0.0, -1.0), Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  EXPECT_NEAR(Simulation(with_floor, alone).motion_ratio(), 0.5, 1e-15);
  Scene with_sphere = fast_bar();
  with_sphere.add_sphere(Vec3(0.0, 0.0, 1.0), 0.01, 2500.0, kMaterial);
  EXPECT_NEAR(Simulation(with_sphere, alone).motion_ratio(), 0.5, 1e-15);
}

}  // namespace
}  // namespace plekton::dynamics::motion_step_test
