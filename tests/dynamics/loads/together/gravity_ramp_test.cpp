// SPDX-License-Identifier: GPL-3.0-or-later
// Gravity that follows a table.
#include "tests/support/loaded_scene.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace plekton::test::gravity_ramp_test {
namespace {

using dynamics::TimeTable;

constexpr double kEps = std::numeric_limits<double>::epsilon();
const Vec3 kGravity(0.0, 1.0, -8.0);

TEST(GravityRamp, PullsByThePartThatItsTableSays) {
  Scene scene;
  add_lump(scene, Vec3(5.0, 5.0, 5.0));
  scene.loads.gravity_factor = TimeTable({{0.0, 0.0}, {1.0, 1.0}});
  auto simulation = simulation_of(scene, 0.25, kGravity);

  Vec3 velocity = Vec3::Zero();
  for (const double factor : {0.0, 0.25, 0.5, 0.75, 1.0, 1.0}) {
    simulation.step();
    velocity += 0.25 * factor * kGravity;
    EXPECT_EQ(simulation.state().velocity[0], velocity);
  }
}

TEST(GravityRamp, IsCountedInTheEnergyToRounding) {
  Scene scene;
  add_lump(scene, Vec3(100.0, 5.0, 500.0));
  scene.state.velocity[0] = Vec3(0.0, 0.0, 20.0);
  scene.loads.gravity_factor = TimeTable({{0.0, 0.0}, {1.0, 1.0}, {1.5, -0.5}});
  auto simulation = simulation_of(scene, 0.01, kGravity);

  // Each of 300 steps rounds sums of m x (1000 kg m) that gravity turns into energy.
  EXPECT_LT(closure_until(simulation, 3.0), 300.0 * 4.0 * kEps * 8.0 * 1000.0 / 400.0);
  EXPECT_NE(simulation.energy().external_work, 0.0);
}

TEST(GravityRamp, IsNoWorkWhereTheFactorStays) {
  Scene scene;
  add_lump(scene, Vec3(0.0, 0.0, 5.0));
  scene.loads.gravity_factor = TimeTable(0.5);
  auto simulation = simulation_of(scene, 0.01, kGravity);

  for (int i = 0; i < 100; ++i) simulation.step();

  EXPECT_EQ(simulation.energy().external_work, 0.0);
}

}  // namespace
}  // namespace plekton::test::gravity_ramp_test
