// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/breaking_net.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// A ball that falls on a net, or on a membrane that wraps around it, touches rings of wires or
/// facets that open and close all the time.
namespace plekton::dynamics::ring_energy_test {
namespace {

using test::add_net;
using test::kMesh;
using test::kWireRadius;
using test::NetOptions;

/// What energy is not accounted for at most, over the largest that contacts store.
double closure_of_fall(const NetOptions& net, double step) {
  constexpr double kRadius = 0.3;
  Scene scene;
  scene.materials = {{2e6, 0.0, 0.0}};
  add_net(scene, net);
  scene.add_sphere(Vec3(0.04, 0.02, kRadius + kWireRadius + 1e-3), kRadius, 1000.0, test::kWire);
  scene.state.velocity.back() = Vec3(0.5, 0.2, -3.0);
  test::BreakingSimulation simulation(scene,
                                      {.time_step = step, .motion = {.gravity = Vec3::Zero()}});
  double error = 0.0, stored = 0.0;
  while (simulation.time() < 0.05) {
    simulation.step();
    const Energy energy = simulation.energy();
    error = std::max(error, std::abs(energy.closure_error()));
    stored = std::max(stored, energy.contact_elastic);
  }
  return error / stored;
}

TEST(EnergyOfASphereOnRings, IsKeptToTheSecondOrderOfTheStep) {
  for (const bool has_facets : {false, true}) {
    SCOPED_TRACE(has_facets ? "membrane" : "net");
    NetOptions net;
    net.squares = 8;
    net.has_facets = has_facets;
    net.has_cylinders = !has_facets;

    const double coarse = closure_of_fall(net, 4e-5);
    const double fine = closure_of_fall(net, 2e-5);

    // What a net that wraps the ball gives back makes its nodes stiffer than a single contact.
    EXPECT_LT(fine, 3e-5);
    EXPECT_NEAR(fine / coarse, 0.25, 0.05);
  }
}

}  // namespace
}  // namespace plekton::dynamics::ring_energy_test
