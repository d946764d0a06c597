// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"
#include "tests/support/free_swing.hpp"
#include "tests/support/refinement.hpp"
#include "tests/support/sheet_meshes.hpp"

#include <gtest/gtest.h>

#include <numbers>

/// Sheets that move.
namespace plekton::test::sheet_motion_test {
namespace {

using dynamics::Simulation;

constexpr double kDensity = 1000.0;  // kg/m³
const SheetSection kPlate = dynamics::solid_sheet(0.02, 1e9, 0.3);

/// 1/s, of the lowest mode of a clamped disk of 1 m.
double lowest_frequency(int rings) {
  Scene scene = sheet_of(disk(1.0, rings), kPlate, kDensity, [](const Vec3& x) {
    return x.norm() > 1.0 - 1e-9 ? Held::everything : Held::nothing;
  });
  std::vector<double> shape;  // kg, near the lowest mode, times the mass
  for (std::size_t i = 0; i < scene.state.size(); ++i) {
    const double w = std::pow(1.0 - scene.state.position[i].squaredNorm(), 2);
    shape.push_back(w * scene.properties.mass[i]);
    scene.state.velocity[i] = Vec3(0.0, 0.0, 1e-4 * w);
  }
  Simulation simulation(scene, {});
  return frequency_of_swing(simulation, shape);
}

// omega = 10.2158 / a² sqrt(D / (rho t)) (Leissa, Vibration of Plates (1969), 2.1).
TEST(SheetMotion, AClampedPlateSwingsAtItsFrequency) {
  const double expected = 10.2158 / (2.0 * std::numbers::pi) *
                          std::sqrt(kPlate.bending_stiffness / (kDensity * kPlate.thickness));
  Refinement table("clamped circular plate, lowest frequency (1/s)", expected);
  for (const int rings : {4, 8, 16}) table.add(rings, lowest_frequency(rings));
  table.print();
  EXPECT_LT(table.last_error(), 0.01);
  EXPECT_GT(table.last_order(), 1.7);
}

/// A disk that flies, spins and swings, nothing held.
Scene flying_disk() {
  Scene scene = sheet_of(disk(1.0, 5), kPlate, kDensity, [](const Vec3&) { return Held::nothing; });
  Random random(31);
  for (std::size_t i = 0; i < scene.state.size(); ++i) {
    scene.state.velocity[i] = Vec3(1.0, 2.0, 3.0) +
                              Vec3(0.5, -1.0, 2.0).cross(scene.state.position[i]) +
                              random.in_cube(0.5);
    scene.state.angular_velocity[i] = Vec3(0.5, -1.0, 2.0) + random.in_cube(1.0);
  }
  return scene;
}

Vec3 momentum(const Simulation& simulation) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < simulation.state().size(); ++i)
    sum += simulation.properties().mass[i] * simulation.state().velocity[i];
  return sum;
}

Vec3 angular_momentum(const Simulation& simulation) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < simulation.state().size(); ++i) {
    sum += simulation.properties().mass[i] *
               simulation.state().position[i].cross(simulation.state().velocity[i]) +
           simulation.properties().inertia[i] * simulation.state().angular_velocity[i];
  }
  return sum;
}

TEST(SheetMotion, AFreeSheetKeepsItsMomentaAndItsEnergy) {
  Simulation simulation(flying_disk(), {});
  const Vec3 push = momentum(simulation);
  const Vec3 turn = angular_momentum(simulation);
  double worst = 0.0;
  for (int step = 0; step < 2000; ++step) {
    simulation.step();
    worst = std::max(worst, std::abs(simulation.energy().closure_error()));
  }

  // Velocities are half a step behind positions, but x_(n+1) x v_(n+1/2) = x_n x v_(n+1/2).
  EXPECT_LT((momentum(simulation) - push).norm(), 1e-12 * push.norm());
  EXPECT_LT((angular_momentum(simulation) - turn).norm(), 1e-11 * turn.norm());
  EXPECT_GT(simulation.energy().sheet_elastic, 0.0);
  EXPECT_LT(worst, 0.01 * simulation.energy().initial);
}

TEST(SheetMotion, IsTheSameToTheLastBitForAnyNumberOfThreads) {
  const auto positions = [](int threads) {
    dynamics::SimulationOptions options;
    options.threads = threads;
    Simulation simulation(flying_disk(), options);
    for (int step = 0; step < 300; ++step) simulation.step();
    return simulation.state().position;
  };
  const std::vector<Vec3> one = positions(1);
  EXPECT_EQ(positions(2), one);
  EXPECT_EQ(positions(4), one);
}

}  // namespace
}  // namespace plekton::test::sheet_motion_test
