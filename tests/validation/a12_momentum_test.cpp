// SPDX-License-Identifier: GPL-3.0-or-later
// A12: a free collision of a ball with a cylinder or a facet keeps linear and angular momentum.
#include "tests/support/free_collision.hpp"

#include <gtest/gtest.h>

namespace plekton::test::a12_momentum_test {
namespace {

class A12Momentum : public testing::TestWithParam<Collision> {};

TEST_P(A12Momentum, IsKeptThroughAFreeCollision) {
  constexpr double kTolerance = 1e-10;
  dynamics::SimulationOptions options;
  options.time_step = kCollisionTimeStep;
  Simulation simulation(collision_scene(GetParam()), options);
  const Momenta before = momenta_of(simulation);

  double worst_linear = 0.0;
  double worst_angular = 0.0;
  int in_contact = 0;
  for (int sample = 0; sample < 600; ++sample) {
    for (int k = 0; k < 200; ++k) simulation.step();
    const Momenta now = momenta_of(simulation);
    worst_linear =
        std::max(worst_linear, (now.linear - before.linear).norm() / before.linear.norm());
    worst_angular =
        std::max(worst_angular, (now.angular - before.angular).norm() / before.angular.norm());
    in_contact += simulation.contacts().counts().sphere_surface > 0;
  }

  EXPECT_NEAR(simulation.time(), kCollisionTime, 1e-12);
  EXPECT_GT(in_contact, 0);
  EXPECT_LE(worst_linear, kTolerance);
  EXPECT_LE(worst_angular, kTolerance);
}

INSTANTIATE_TEST_SUITE_P(SphereOn, A12Momentum, testing::ValuesIn(kCollisions),
                         [](const auto& collision) { return collision.param.name; });

}  // namespace
}  // namespace plekton::test::a12_momentum_test
