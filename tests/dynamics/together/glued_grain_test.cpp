// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/cohesive_frictional.hpp"
#include "contact/models.hpp"
#include "dynamics/simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

/// A grain that is glued beside the middle of something bent, without any tangential force, swings
/// for ever: between elastic energy and motion, and nothing is dissipated.
namespace plekton::test::glued_grain_test {
namespace {

using dynamics::Held;
using dynamics::Scene;
using dynamics::Simulation;
using geometry::NodeId;
using geometry::Vec3;

constexpr contact::MaterialId kGlue{0};
constexpr double kRadius = 1e-3;  // m, of bars and facets

Scene held(const std::vector<Vec3>& nodes) {
  Scene scene;
  scene.materials = {{.young_modulus = 5e6, .stiffness_ratio = 0.0, .friction = 0.5}};
  for (const Vec3& x : nodes) scene.add_node(x, Held::everything);
  return scene;
}

Scene star() {
  constexpr double kArm = 0.02;
  Scene scene = held(
      {Vec3::Zero(), {kArm, 0.0, 0.0}, {-kArm, 0.0, 0.0}, {0.0, kArm, 0.0}, {0.0, -kArm, 0.0}});
  for (int arm = 1; arm <= 4; ++arm) scene.add_cylinder(NodeId{0}, NodeId{arm}, kRadius, kGlue);
  return scene;
}

/// Two facets on either side of x = 0, each so steep.
Scene valley(double slope) {
  constexpr double kSide = 0.04;
  Scene scene = held({{0.0, -kSide, 0.0},
                      {0.0, kSide, 0.0},
                      {kSide, 0.0, slope * kSide},
                      {-kSide, 0.0, slope * kSide}});
  scene.add_facet(NodeId{0}, NodeId{2}, NodeId{1}, kRadius, kGlue);
  scene.add_facet(NodeId{1}, NodeId{3}, NodeId{0}, kRadius, kGlue);
  return scene;
}

/// @param height  m, of its centre
void expect_to_swing(Scene scene, double height, const Vec3& velocity) {
  scene.add_sphere(Vec3(0.0007, 0.0004, height), 0.01, 2500.0, kGlue);
  scene.state.velocity.back() = velocity;
  dynamics::SimulationOptions options;
  options.motion.gravity = Vec3::Zero();
  options.time_step = 4e-6;
  const auto model =
      contact::model_of<contact::CohesiveFrictional>({{{kGlue, kGlue}, {1e9, 1e9, 0.0}}});
  Simulation simulation(scene, options, model);
  const double stored = simulation.energy().initial;
  double off = 0.0, apart = 0.0;
  while (simulation.time() < 0.15) {
    simulation.step();
    const dynamics::Energy energy = simulation.energy();
    off = std::max(off, std::abs(energy.kinetic + energy.contact_elastic - stored));
    off = std::max(off, std::abs(energy.friction));
    apart = std::max(apart, simulation.state().position.back().z() - height);
  }
  EXPECT_GT(apart, 2e-5);  // it does pull
  EXPECT_LT(off, 1e-3 * stored);
}

// It had 200 times the energy by then, taken off as friction.
TEST(GluedGrain, OnAKnotOfWiresKeepsItsEnergy) {
  expect_to_swing(star(), 0.01095, Vec3::Zero());
}

TEST(GluedGrain, InACreaseKeepsItsEnergy) {
  for (const double slope : {0.05, 0.25})
    expect_to_swing(valley(slope), 0.01095 * std::hypot(1.0, slope), Vec3(0.01, 0.005, 0.0));
}

}  // namespace
}  // namespace plekton::test::glued_grain_test
