// SPDX-License-Identifier: GPL-3.0-or-later
// A user's own contact law in a simulation: one file, and the model that is made of it.
#include "contact/models.hpp"
#include "dynamics/simulation.hpp"
#include "tests/support/weakening_slider.hpp"

#include <gtest/gtest.h>

namespace plekton::dynamics::own_law_test {
namespace {

/// Spheres that slide down between two planes.
Scene slide() {
  Scene scene;
  scene.materials = {{5e6, 0.3, 0.5}};
  const contact::MaterialId stone{0};
  for (int k = 0; k < 40; ++k) {
    const Vec3 centre(0.021 * (k % 8) + 0.003 * (k / 8), 0.0205 * (k / 8), 0.0101);
    scene.add_sphere(centre, 0.01, 2500.0, stone);
  }
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), stone});
  scene.planes.push_back({Vec3(0.18, 0, 0), -Vec3::UnitX(), Vec3::Zero(), stone});
  return scene;
}

Simulation slid_for_a_while(int threads) {
  SimulationOptions options;
  options.motion.gravity = Vec3(7.0, 0.3, -7.0);
  options.threads = threads;
  options.time_step = 1e-5;
  return {slide(), options, contact::model_of<test::WeakeningSlider>()};
}

TEST(OwnLaw, KeepsTheBalanceOfEnergy) {
  auto simulation = slid_for_a_while(1);
  for (int step = 0; step < 10000; ++step) simulation.step();

  const Energy energy = simulation.energy();
  EXPECT_GT(energy.friction, 0.0);
  EXPECT_GT(simulation.contacts().counts().sphere_sphere, 0U);
  // With frequencies w of some sqrt(4 k / m) = 4400 / s the leapfrog keeps elastic energy to
  // (w dt)^2 / 4.
  EXPECT_LT(energy.closure(), 1e-3);
}

TEST(OwnLaw, HasTheSameBitsForAnyNumberOfThreads) {
  auto one = slid_for_a_while(1);
  auto two = slid_for_a_while(2);
  for (int step = 0; step < 3000; ++step) {
    one.step();
    two.step();
  }

  EXPECT_EQ(one.state().position, two.state().position);
  EXPECT_EQ(one.state().angular_velocity, two.state().angular_velocity);
}

}  // namespace
}  // namespace plekton::dynamics::own_law_test
