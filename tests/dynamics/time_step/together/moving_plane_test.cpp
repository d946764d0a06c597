// SPDX-License-Identifier: GPL-3.0-or-later
// Planes that no load moves, and the step that is chosen while they come.
#include "dynamics/simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plekton::dynamics::moving_plane_test {
namespace {

constexpr contact::MaterialId kMaterial{0};
constexpr double kSpeed = 1.0;  // m/s

/// A soft bar of 0.2 m at rest whose free end a stiff wall is to strike, 5 mm further.
Scene soft_bar() {
  Scene scene;
  scene.materials = {{1e7, 0.3, 0.4}};
  scene.add_node(Vec3::Zero(), Held::everything);
  scene.add_node(Vec3(0.2, 0.0, 0.0), Held::rotation | Held::along_y | Held::along_z);
  scene.add_beam(NodeId{0}, NodeId{1}, bar_section(0.01, 1e4), 1000.0);
  scene.add_cylinder(NodeId{0}, NodeId{1}, 0.01, kMaterial);
  scene.planes.push_back({Vec3(0.215, 0.0, 0.0), -Vec3::UnitX(), Vec3::Zero(), kMaterial});
  return scene;
}

/// Of the free end, m/s, until a time (s).
double fastest_until(Simulation& simulation, double end) {
  double fastest = 0.0;
  while (simulation.time() < end) {
    simulation.step();
    fastest = std::max(fastest, std::abs(simulation.state().velocity[1].x()));
  }
  return fastest;
}

/// A wall throws what rests by twice its speed. The step of the bar alone is 60 ms, in which the wall
/// goes 60 mm. With omega dt = 1/2, by which collisions are followed, a spring that begins or ends
/// within a step is off by up to (omega dt / 2)² of its energy: the ball leaves the wall with up to
/// sqrt(1 + 2 / 16) of the speed that it came with.
void expect_thrown(Simulation& simulation) {
  const double fastest = fastest_until(simulation, simulation.time() + 0.02);

  const double error = std::sqrt(1.0 + 2.0 / 16.0) - 1.0;
  EXPECT_NEAR(fastest, 2.0 * kSpeed, error * kSpeed);
}

TEST(ChosenStep, IsShortEnoughForAPlaneThatMovesByItself) {
  Scene scene = soft_bar();
  scene.planes[0].velocity = Vec3(-kSpeed, 0.0, 0.0);
  Simulation simulation(scene, {.motion = {.gravity = Vec3::Zero()}});

  expect_thrown(simulation);
}

TEST(ChosenStep, IsLookedAtWhereAPlaneIsSetInMotion) {
  Simulation simulation(soft_bar(), {.motion = {.gravity = Vec3::Zero()}});
  simulation.step();

  simulation.set_plane_velocity(0, Vec3(-kSpeed, 0.0, 0.0));

  expect_thrown(simulation);
}

}  // namespace
}  // namespace plekton::dynamics::moving_plane_test
