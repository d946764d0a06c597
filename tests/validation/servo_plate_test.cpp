// SPDX-License-Identifier: GPL-3.0-or-later
// A plate under servo control holds its target on a bed of grains.
#include "tests/support/loaded_scene.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plekton::servo_plate_test {
namespace {

using dynamics::PlaneServo;
using dynamics::Scene;
using dynamics::TimeTable;
using geometry::Vec3;
using Simulation = test::LoadedSimulation;

constexpr double kRadius = 0.005;     // m
constexpr double kHalfWidth = 0.029;  // m, of the box
constexpr contact::MaterialId kMaterial{0};
constexpr std::size_t kPlate = 5;

/// About 100 grains over a floor, between walls and under a plate.
Scene box_of_grains() {
  Scene scene;
  scene.materials = {{1e7, 0.3, 0.4}};
  test::Random random(5);
  for (int layer = 0; layer < 4; ++layer) {
    for (int row = 0; row < 5; ++row) {
      for (int i = 0; i < 5; ++i) {
        const Vec3 cell(i - 2.0, row - 2.0, layer + 0.6);
        scene.add_sphere(0.0115 * cell + random.in_cube(5e-4),
                         random.uniform(0.8 * kRadius, kRadius), 2650.0, kMaterial);
      }
    }
  }
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)})
    scene.planes.push_back({-kHalfWidth * normal, normal, Vec3::Zero(), kMaterial});
  scene.planes.push_back({Vec3(0, 0, 0.055), -Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  return scene;
}

Simulation simulation_of(const Scene& scene, int threads = 1) {
  dynamics::SimulationOptions options;
  options.motion = {Vec3(0.0, 0.0, -9.81), 0.2, true};
  options.threads = threads;
  return Simulation(scene, options);
}

/// N, with which the bodies press on a plane.
double pressing(const Simulation& simulation, std::size_t plane) {
  return -simulation.contacts().on_plane(plane).force.dot(simulation.planes()[plane].normal);
}

/// Largest distance of the force on the plate from a target, over the target, in a time (s).
double largest_error(Simulation& simulation, double target, double duration) {
  const double end = simulation.time() + duration;
  double error = 0.0;
  while (simulation.time() < end) {
    simulation.step();
    error = std::max(error, std::abs(pressing(simulation, kPlate) - target) / target);
  }
  return error;
}

void run_until(Simulation& simulation, double time) {
  while (simulation.time() < time) simulation.step();
}

TEST(ServoPlate, HoldsAForceOnABedWithinOnePercent) {
  Scene scene = box_of_grains();
  PlaneServo servo;
  servo.plane = kPlate;
  servo.force = 50.0;
  servo.largest_speed = 0.2;
  scene.loads.servos.push_back(servo);
  Simulation simulation = simulation_of(scene);

  run_until(simulation, 0.4);

  EXPECT_LT(largest_error(simulation, 50.0, 0.1), 0.01);
  EXPECT_GE(simulation.contacts().counts().with_planes, 25u);
  EXPECT_LT(simulation.energy().closure(), 0.01);
}

TEST(ServoPlate, FollowsATargetThatChangesSlowly) {
  Scene scene = box_of_grains();
  PlaneServo servo;
  servo.plane = kPlate;
  servo.force = 50.0;
  servo.factor = TimeTable({{0.4, 1.0}, {0.6, 2.0}});
  servo.largest_speed = 0.2;
  scene.loads.servos.push_back(servo);
  Simulation simulation = simulation_of(scene);

  run_until(simulation, 0.5);
  EXPECT_NEAR(pressing(simulation, kPlate), 50.0 * servo.factor.at(simulation.time()), 0.05 * 75.0);

  run_until(simulation, 0.7);
  EXPECT_LT(largest_error(simulation, 100.0, 0.1), 0.01);
}

TEST(ServoPlate, HoldsAStressOnTheAreaBetweenMovingWalls) {
  Scene scene = box_of_grains();
  PlaneServo servo;
  servo.plane = kPlate;
  servo.pressure = 1e4;
  servo.between = {{1, 2}, {3, 4}};
  servo.largest_speed = 0.2;
  PlaneServo wall = servo;  // on one side wall, whose area changes with the plate
  wall.plane = 2;
  wall.between = {{3, 4}, {0, kPlate}};
  scene.loads.servos = {servo, wall};
  Simulation simulation = simulation_of(scene);

  run_until(simulation, 0.5);
  const auto& planes = simulation.planes();
  const double width = planes[2].point.x() - planes[1].point.x();
  const double height = planes[kPlate].point.z();

  EXPECT_LT(width, 2.0 * kHalfWidth);
  EXPECT_LT(largest_error(simulation, 1e4 * width * 2.0 * kHalfWidth, 0.05), 0.02);
  EXPECT_NEAR(pressing(simulation, 2), 1e4 * 2.0 * kHalfWidth * height, 0.02 * 1e4 * 0.0025);
}

TEST(ServoPlate, GivesTheSameBitsForAnyNumberOfThreads) {
  Scene scene = box_of_grains();
  PlaneServo servo;
  servo.plane = kPlate;
  servo.force = 50.0;
  servo.largest_speed = 0.2;
  scene.loads.servos.push_back(servo);
  Simulation one = simulation_of(scene);
  run_until(one, 0.1);

  for (const int threads : {2, 4}) {
    Simulation many = simulation_of(scene, threads);
    run_until(many, 0.1);
    EXPECT_EQ(many.state().position, one.state().position) << threads;
    EXPECT_EQ(many.planes()[kPlate].point, one.planes()[kPlate].point) << threads;
  }
}

}  // namespace
}  // namespace plekton::servo_plate_test
