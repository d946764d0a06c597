// SPDX-License-Identifier: GPL-3.0-or-later
// A20: a hollow sphere of facets and beams hits a wall at 1 m/s and bounces back; no gravity, no
// friction, no damping. What it does not get back is in its vibrations.
#include "dynamics/simulation.hpp"
#include "tests/support/lattice_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

namespace plekton::test::a20_bounce_test {
namespace {

using dynamics::Held;
using dynamics::Simulation;
using geometry::Vec3;

constexpr double kSphereRadius = 0.1;  // m
constexpr double kThickness = 0.004;   // m, radius of facets and beams
constexpr double kModulus = 5e6;       // Pa
constexpr double kSpeed = 1.0;         // m/s

struct Bounce {
  double restitution;
  double contact_time;  ///< s
  double least_height;  ///< over the height at the start
  double energy_error;  ///< largest deviation of the energy, over the energy at the start
};

dynamics::Scene sphere_before_wall() {
  dynamics::Scene scene;
  scene.materials = {{kModulus, 0.3, 0.0}};
  add_lattice(scene, geometry::icosphere(kSphereRadius, 2), Vec3::Zero(),
              {kThickness, dynamics::circular_section(kThickness, kModulus, 0.3), 1000.0},
              [](const Vec3&) { return Held::nothing; });
  for (Vec3& velocity : scene.state.velocity) velocity = Vec3(0.0, 0.0, -kSpeed);
  const double wall = -kSphereRadius - kThickness - 1e-3;
  scene.planes.push_back(
      {Vec3(0.0, 0.0, wall), Vec3::UnitZ(), Vec3::Zero(), contact::MaterialId{0}});
  return scene;
}

double height_of(const Simulation& simulation) {
  const auto& x = simulation.state().position;
  const auto [low, high] = std::minmax_element(
      x.begin(), x.end(), [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
  return high->z() - low->z();
}

Bounce bounce(double time_step) {
  dynamics::SimulationOptions options;
  options.time_step = time_step;
  Simulation simulation(sphere_before_wall(), options);
  const double height = height_of(simulation);
  Bounce result{0.0, 0.0, 1.0, 0.0};
  double first_contact = -1.0, last_contact = -1.0;
  while (first_contact < 0.0 || simulation.time() < last_contact + 0.03) {
    simulation.step();
    if (simulation.contacts().counts().with_planes > 0) {
      last_contact = simulation.time();
      if (first_contact < 0.0) first_contact = last_contact;
    }
    result.least_height = std::min(result.least_height, height_of(simulation) / height);
    const dynamics::Energy energy = simulation.energy();
    result.energy_error =
        std::max(result.energy_error, std::abs(energy.closure_error()) / energy.initial);
  }
  result.contact_time = last_contact - first_contact;
  result.restitution =
      centre_of_mass(simulation, 0, simulation.state().size()).velocity.z() / kSpeed;
  std::printf(
      "hollow sphere, step %.3g s: e = %.4f, contact %.4f s, least height %.4f, energy %.2g\n",
      time_step, result.restitution, result.contact_time, result.least_height, result.energy_error);
  return result;
}

TEST(A20Bounce, AHollowSphereKeepsItsEnergyAndTheResultDoesNotDependOnTheStep) {
  constexpr double kStep = 8.5e-5;  // s
  const Bounce coarse = bounce(kStep);
  const Bounce fine = bounce(0.5 * kStep);

  EXPECT_GT(coarse.restitution, 0.85);
  EXPECT_LT(coarse.restitution, 1.0);
  EXPECT_LT(std::abs(fine.restitution / coarse.restitution - 1.0), 5e-3);
  EXPECT_LT(coarse.energy_error, 5e-3);
  EXPECT_LT(fine.energy_error, 0.5 * coarse.energy_error);
}

}  // namespace
}  // namespace plekton::test::a20_bounce_test
