// SPDX-License-Identifier: GPL-3.0-or-later
// A13: a free collision without friction keeps the energy; with friction it never gains any, and
// what is missing is what friction took.
#include "tests/support/free_collision.hpp"

#include <gtest/gtest.h>

namespace plekton::test::a13_energy_test {
namespace {

class A13Energy : public testing::TestWithParam<Collision> {};

struct EnergyRange {
  double least = 0.0;  ///< of kinetic + elastic energy, over the initial one, minus 1
  double largest = 0.0;
  double closure = 0.0;  ///< largest closure error of the ledger over the initial energy
};

EnergyRange energy_through(const Collision& collision, double time_step) {
  dynamics::SimulationOptions options;
  options.time_step = time_step;
  Simulation simulation(collision_scene(collision), options);
  EnergyRange range;
  while (simulation.time() < kCollisionTime) {
    simulation.step();
    const dynamics::Energy now = simulation.energy();
    const double change =
        (now.kinetic + now.contact_elastic + now.bond_elastic) / now.initial - 1.0;
    range.least = std::min(range.least, change);
    range.largest = std::max(range.largest, change);
    range.closure = std::max(range.closure, std::abs(now.closure_error()) / now.initial);
  }
  return range;
}

TEST_P(A13Energy, IsKeptWithoutFrictionAndNeverGained) {
  constexpr double kTolerance = 1e-3;
  for (const double time_step :
       {kCollisionTimeStep, 4.0 * kCollisionTimeStep, 16.0 * kCollisionTimeStep}) {
    const EnergyRange range = energy_through(GetParam(), time_step);

    EXPECT_LE(range.largest, kTolerance) << "time step " << time_step;
    EXPECT_LE(range.closure, kTolerance) << "time step " << time_step;
    if (GetParam().friction_angle == 0.0) {
      EXPECT_GE(range.least, -kTolerance) << "time step " << time_step;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(SphereOn, A13Energy, testing::ValuesIn(kCollisions),
                         [](const auto& collision) { return collision.param.name; });

}  // namespace
}  // namespace plekton::test::a13_energy_test
