// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/state_hash.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace plekton::dynamics::state_hash_test {
namespace {

/// Three balls that fall on each other, and a floor.
Scene falling_balls() {
  Scene scene;
  scene.materials = {{.young_modulus = 1e6, .stiffness_ratio = 0.3, .friction = 0.5}};
  scene.add_sphere({0, 0, 0.010}, 0.01, 2650.0, contact::MaterialId{0});
  scene.add_sphere({0.001, 0, 0.0305}, 0.01, 2650.0, contact::MaterialId{0});
  scene.add_sphere({0, 0.001, 0.0515}, 0.01, 2650.0, contact::MaterialId{0});
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), contact::MaterialId{0}});
  return scene;
}

std::uint64_t hash_after(const Scene& scene, int steps, int threads = 1) {
  Simulation run(scene, {.motion = {.gravity = {0, 0, -9.81}}, .threads = threads});
  for (int i = 0; i < steps; ++i) run.step();
  return state_hash(run);
}

TEST(StateHash, IsTheSameForTheSameRunWithAnyNumberOfThreads) {
  EXPECT_EQ(hash_after(falling_balls(), 2000), hash_after(falling_balls(), 2000));
  EXPECT_EQ(hash_after(falling_balls(), 2000), hash_after(falling_balls(), 2000, 3));
}

TEST(StateHash, DiffersFromStepToStep) {
  EXPECT_NE(hash_after(falling_balls(), 2000), hash_after(falling_balls(), 2001));
}

TEST(StateHash, ShowsTheLastBitOfOneCoordinateAndOfAPlane) {
  const Scene scene = falling_balls();
  Scene moved = scene;
  double& x = moved.state.position[1].x();
  x = std::nextafter(x, 1.0);
  Scene lifted = scene;
  lifted.planes[0].point.z() = std::numeric_limits<double>::denorm_min();

  const std::uint64_t hash = hash_after(scene, 0);

  EXPECT_NE(hash_after(moved, 0), hash);
  EXPECT_NE(hash_after(lifted, 0), hash);
}

}  // namespace
}  // namespace plekton::dynamics::state_hash_test
