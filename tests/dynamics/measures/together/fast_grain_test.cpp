// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/diverged.hpp"
#include "dynamics/simulation.hpp"

#include <gtest/gtest.h>

#include <random>

/// A grain or a bar thrown at a thin sheet that is held: caught, or reported, at any speed and any
/// step.
namespace plekton::dynamics::fast_grain_test {
namespace {

constexpr double kRadius = 0.005;
constexpr double kThickness = 1e-4;
constexpr contact::MaterialId kMaterial{0};

Scene held_sheet() {
  Scene scene;
  scene.materials = {{1e8, 0.3, 0.4}};
  std::vector<NodeId> nodes;
  for (const Vec3& x : {Vec3(-0.05, -0.05, 0.0), Vec3(0.05, -0.05, 0.0), Vec3(0.05, 0.05, 0.0),
                        Vec3(-0.05, 0.05, 0.0)}) {
    nodes.push_back(scene.add_node(x));
    scene.properties.held.back() = Held::everything;
  }
  for (const std::array<std::size_t, 3>& f :
       {std::array<std::size_t, 3>{0, 1, 2}, std::array<std::size_t, 3>{0, 2, 3}}) {
    scene.elements.facets.push_back({{nodes[f[0]], nodes[f[1]], nodes[f[2]]}, 0.5 * kThickness});
    scene.facet_materials.push_back(kMaterial);
  }
  return scene;
}

Scene grain_above_sheet(double speed, const Vec3& start) {
  Scene scene = held_sheet();
  scene.add_sphere(start, kRadius, 2500.0, kMaterial);
  scene.state.velocity.back() = Vec3(0.1 * speed, 0.0, -speed);
  return scene;
}

/// A bar 20 mm long that points at the sheet.
Scene bar_above_sheet(double speed, const Vec3& start) {
  Scene scene = held_sheet();
  constexpr double kBarRadius = 5e-4;
  std::vector<NodeId> ends;
  for (const Vec3& x : {start, Vec3(start + Vec3(0.004, 0.0, 0.0196))}) {
    ends.push_back(scene.add_node(x));
    scene.state.velocity.back() = Vec3(0.1 * speed, 0.0, -speed);
  }
  scene.add_cylinder(ends[0], ends[1], kBarRadius, kMaterial);
  scene.add_beam(ends[0], ends[1], circular_section(kBarRadius, 1e9, 0.3), 2500.0);
  return scene;
}

enum class Outcome { caught, reported, unnoticed };

/// @param step  s; 0: chosen
Outcome outcome(double speed, double step, const Vec3& start) {
  Simulation simulation(grain_above_sheet(speed, start),
                        {.time_step = step, .motion = {.gravity = Vec3::Zero()}});
  const std::size_t grain = simulation.state().size() - 1;
  try {
    while (simulation.time() < 0.02 / speed + 2e-3) {
      simulation.step();
      if (simulation.pass_throughs() > 0) return Outcome::reported;
    }
  } catch (const Diverged&) {
    return Outcome::reported;
  }
  return simulation.state().position[grain].z() > 0.0 ? Outcome::caught : Outcome::unnoticed;
}

TEST(FastGrain, IsCaughtOrReportedAtAnySpeedAndAnyStep) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  int caught = 0, reported = 0;
  for (int k = 0; k < 400; ++k) {
    const double speed = std::pow(10.0, -1.0 + 5.0 * u(random));
    const Vec3 start(0.01 * u(random), 0.01 * u(random), kRadius + 0.001 + 0.005 * u(random));
    Scene scene = grain_above_sheet(speed, start);
    const Simulation probe(scene, {.motion = {.gravity = Vec3::Zero()}});
    const double step = kLargestStep * (0.05 + 0.95 * u(random)) * probe.critical_step().dt;
    const Outcome found = outcome(speed, step, start);
    caught += found == Outcome::caught;
    reported += found == Outcome::reported;
    EXPECT_NE(found, Outcome::unnoticed) << speed << " m/s, step " << step << " s";
  }
  EXPECT_GT(caught, 100);
  EXPECT_GT(reported, 20);
}

/// @param step  s; 0: chosen
Outcome outcome_of_bar(double speed, double step, const Vec3& start) {
  Simulation simulation(bar_above_sheet(speed, start),
                        {.time_step = step, .motion = {.gravity = Vec3::Zero()}});
  const std::size_t end = simulation.state().size() - 1;
  try {
    while (simulation.time() < 0.04 / speed + 1e-3) {
      simulation.step();
      if (simulation.most_crossings() > 0) return Outcome::reported;
    }
  } catch (const Diverged&) {
    return Outcome::reported;
  }
  const auto& x = simulation.state().position;
  return x[end].z() > 0.0 && x[end - 1].z() > 0.0 ? Outcome::caught : Outcome::unnoticed;
}

TEST(FastBar, IsCaughtOrReportedAtAnySpeed) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  int caught = 0, reported = 0;
  for (int k = 0; k < 60; ++k) {
    const double speed = std::pow(10.0, -1.0 + 5.0 * u(random));
    const Vec3 start(0.01 * u(random), 0.01 * u(random), 0.001 + 0.002 * u(random));
    const Outcome found = outcome_of_bar(speed, 0.0, start);
    caught += found == Outcome::caught;
    reported += found == Outcome::reported;
    EXPECT_NE(found, Outcome::unnoticed) << speed << " m/s";
  }
  EXPECT_GT(caught, 5);
  EXPECT_GT(reported, 5);
}

TEST(FastGrain, IsCaughtByAChosenStepAsFastAsTheContactCanHold) {
  // Kinetic energy m v^2 / 2 below what the contact stores up to the grain's radius, k R^2 / 2.
  const Vec3 start(0.003, 0.004, 2.0 * kRadius);
  EXPECT_EQ(outcome(1.0, 0.0, start), Outcome::caught);
  EXPECT_EQ(outcome(10.0, 0.0, start), Outcome::caught);
}

TEST(FastGrain, IsReportedWhereItIsFasterThanTheContactCanHold) {
  EXPECT_EQ(outcome(1e4, 0.0, Vec3(0.003, 0.004, 2.0 * kRadius)), Outcome::reported);
}

}  // namespace
}  // namespace plekton::dynamics::fast_grain_test
