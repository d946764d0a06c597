// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/ground_springs.hpp"

#include "tests/support/loaded_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace plekton::test::ground_springs_test {
namespace {

using dynamics::GroundSprings;
using testing::HasSubstr;

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// A lump of 2 kg on springs of 200 N/m, 800 N/m and none.
Scene grounded_lump() {
  Scene scene;
  GroundSprings springs;
  springs.nodes = {add_lump(scene, Vec3(1.0, 2.0, 3.0))};
  springs.stiffness = Vec3(200.0, 800.0, 0.0);
  scene.loads.ground_springs.push_back(springs);
  return scene;
}

TEST(GroundSprings, SwingWithTheirFrequencyAlongEachAxis) {
  Scene scene = grounded_lump();
  scene.state.velocity[0] = Vec3(0.1, 0.1, 0.1);
  const double dt = 1e-4;
  auto simulation = simulation_of(scene, dt);

  const double period = 2.0 * std::numbers::pi / 10.0;  // s, along x; half of it along y
  const auto steps = static_cast<int>(std::lround(period / dt));
  for (int i = 0; i < steps; ++i) simulation.step();

  // Back where it was but for the steps, which are no part of the period, and the frequency of the
  // leapfrog, which is higher by (w dt)²/24.
  const double late = std::abs(steps * dt - period) + period * 400.0 * dt * dt / 24.0;
  const Vec3& place = simulation.state().position[0];
  EXPECT_NEAR(place.x(), 1.0, 1.01 * 0.1 * late);
  EXPECT_NEAR(place.y(), 2.0, 1.01 * 0.1 * late);
  // Half a unit in the last place of 3 m in each step.
  EXPECT_NEAR(place.z(), 3.0 + 0.1 * steps * dt, steps * kEps);
}

TEST(GroundSprings, KeepTheEnergyToRounding) {
  Scene scene = grounded_lump();
  scene.state.velocity[0] = Vec3(0.1, 0.3, 0.1);
  auto simulation = simulation_of(scene, 0.02);

  // A spring's energy is the work of the trapezoidal rule: only rounding is left, in each of 500
  // steps of what its place is rounded by.
  const double work_of_rounding = 800.0 * 0.02 * 3.0 * kEps;  // J: force times the rounding of 3 m
  EXPECT_LT(closure_until(simulation, 10.0), 500.0 * 4.0 * work_of_rounding / 0.09);
}

TEST(GroundSprings, SetTheCriticalStep) {
  const LoadedSimulation simulation(grounded_lump(), {});

  EXPECT_DOUBLE_EQ(simulation.critical_step().dt, 2.0 / std::sqrt(800.0 / 2.0));
}

TEST(GroundSprings, AreRefusedWithNegativeStiffness) {
  Scene scene = grounded_lump();
  scene.loads.ground_springs[0].stiffness.y() = -1.0;

  EXPECT_THAT(problems_of(scene), HasSubstr("ground springs 0: stiffness (200  -1   0) N/m must be "
                                            "finite and not negative"));
}

}  // namespace
}  // namespace plekton::test::ground_springs_test
