// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"
#include "geometry/mesh/generate/lattice.hpp"
#include "geometry/mesh/generate/membrane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

/// A boulder falls into a net that wraps around it: more and more wires hang together in range, all
/// of them come to be one contact, and many again as the boulder leaves.
namespace plekton::test::boulder_in_net_test {
namespace {

using dynamics::Scene;
using dynamics::Simulation;
using geometry::Vec3;

constexpr contact::MaterialId kMaterial{0};

/// Of 24 x 24 meshes of 50 mm, held at its rim, and a boulder of 40 kg above it at 5 m/s.
Scene boulder_above_net() {
  constexpr int kMeshes = 24;
  constexpr double kMesh = 0.05, kWire = 1.35e-3, kRadius = 0.2, kMass = 40.0;
  Scene scene;
  scene.materials = {{1e8, 0.3, 0.5}};
  const auto net = geometry::biaxial_geogrid({kMesh, kMesh, kMeshes, kMeshes});
  for (const Vec3& point : net.points) {
    const geometry::NodeId node = scene.add_node(point);
    if (point.head<2>().cwiseAbs().maxCoeff() > (0.5 * kMeshes - 0.5) * kMesh)
      scene.properties.held[index_of(node)] = dynamics::Held::everything;
  }
  for (const auto& bar : geometry::cylinders_of(net, kWire, 0)) {
    scene.add_cylinder(bar.nodes[0], bar.nodes[1], bar.radius, kMaterial);
    scene.add_beam(bar.nodes[0], bar.nodes[1], dynamics::circular_section(kWire, 1e10, 0.3),
                   7850.0);
  }
  const double volume = 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius;
  scene.add_sphere(Vec3(0, 0, kRadius + kWire + 5e-3), kRadius, kMass / volume, kMaterial);
  scene.state.velocity.back() = Vec3(0, 0, -5);
  return scene;
}

// 1 mJ a Joule: contacts begin and end in steps of 0.65 of the critical one (time_step.md).
TEST(BoulderInANet, IsCaughtAndThrownBackWithTheEnergyThatItHas) {
  dynamics::SimulationOptions options;
  options.self_contact = false;
  Simulation simulation(boulder_above_net(), options);
  const double initial = 0.5 * 40.0 * 25.0;
  double deepest = 0.0, most = 0.0;
  std::size_t least_contacts = 1000;
  while (simulation.time() < 0.3) {
    simulation.step();
    const Vec3 boulder = simulation.scene().state.position.back();
    deepest = std::min(deepest, boulder.z());
    const dynamics::Energy energy = simulation.energy();
    most = std::max(most, energy.contact_elastic);
    if (energy.contact_elastic > 0.01 * initial)
      least_contacts = std::min(least_contacts, simulation.contacts().counts().sphere_surface);
    ASSERT_LE(std::abs(energy.closure_error()), 1e-3 * initial) << simulation.time();
  }
  const dynamics::NodeState& state = simulation.scene().state;
  EXPECT_GT(state.velocity.back().z(), 0.5 * 5.0);
  EXPECT_GT(state.position.back().z(), 0.0);
  EXPECT_GT(most, 0.01 * initial);
  EXPECT_EQ(least_contacts, 1);  // it was wrapped
  EXPECT_GT(deepest, -0.2);
}

}  // namespace
}  // namespace plekton::test::boulder_in_net_test
