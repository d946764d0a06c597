// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"
#include "tests/support/loaded_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plekton::test::pushing_ties_test {
namespace {

constexpr double kStiffness = 2e6;          // N/m, on lumps of 2 kg: 1000 rad/s
constexpr double kCritical = 2.0 / 1000.0;  // s
constexpr double kRest = 1e-3;              // m
const double kBear = kRest * 1000.0;        // m/s, at which a lump gets through the tie

/// A lump that flies past the place to which it is tied, where the tie has no length.
Scene lump(const Vec3& from, const Vec3& velocity, double rest_length) {
  Scene scene;
  const NodeId node = add_lump(scene, from);
  scene.state.velocity[index_of(node)] = velocity;
  scene.ties.push_back({.node = node,
                        .to = dynamics::FixedPoint{Vec3::Zero()},
                        .stiffness = kStiffness,
                        .rest_length = rest_length});
  return scene;
}

/// The force of a tie turns round where the node goes by its end.
TEST(PushingTies, KeepTheirEnergyAsTheyGoThroughThemselves) {
  for (const double miss : {0.0, 0.003, 0.01, 0.03, 0.1}) {
    const Scene scene = lump({-kRest, miss * kRest, 0.0}, {1.5 * kBear, 0.0, 0.0}, kRest);
    LoadedSimulation simulation = simulation_of(scene, 0.0);
    EXPECT_LT(closure_until(simulation, 2e-3), 1.0 / 16.0) << miss;
  }
}

TEST(PushingTies, KeepTheirEnergyWhereTheyBeginWithoutALength) {
  for (const double speed : {0.01, 0.3, 1.0, 3.0}) {
    LoadedSimulation simulation =
        simulation_of(lump(Vec3::Zero(), {0.0, speed * kBear, 0.0}, kRest), 0.0);
    EXPECT_LT(closure_until(simulation, 2e-3), 1.0 / 16.0) << speed;
  }
}

/// Between places that are one but for rounding. What they could be off by is nothing beside what
/// moves.
TEST(PushingTies, ThatAreAsShortAsRoundingHaveTheStepOfOthers) {
  for (const double rest : {1e-18, 1e-12, 1e-9}) {
    for (const double part : {0.0, 0.1, 0.9}) {
      const Scene scene = lump({part * rest, 0.0, 0.0}, {0.0, 1.0, 0.0}, rest);
      LoadedSimulation simulation = simulation_of(scene, 0.0);
      EXPECT_GT(simulation.time_step(), 0.1 * kCritical) << rest << ' ' << part;
    }
  }
}

/// Whatever there is to follow, by a part of what is critical.
TEST(PushingTies, NeverTakeMoreThanSoManySteps) {
  for (const double rest : {1e-12, 1e-6, 1e-3, 1.0}) {
    for (double speed = 1e-9; speed < 1e3; speed *= 10.0) {
      LoadedSimulation simulation =
          simulation_of(lump({1e-9 * rest, 0.0, 0.0}, {0.0, speed, 0.0}, rest), 0.0);
      // F v / (m v² / 2 + F² / (2 k)) is at most omega.
      EXPECT_GT(simulation.time_step(), kCritical / 32.0 * (1.0 - 1e-9)) << rest << ' ' << speed;
    }
  }
}

/// A tie that pushes gives way across: it holds nothing there, however short it is.
TEST(PushingTies, AllowAGivenStepOfTheirStiffness) {
  for (const double distance : {0.0, 1e-18, 1e-6})
    EXPECT_NO_THROW(simulation_of(lump({distance, 0.0, 0.0}, Vec3::Zero(), kRest), 0.5 * kCritical))
        << distance;
}

}  // namespace
}  // namespace plekton::test::pushing_ties_test
