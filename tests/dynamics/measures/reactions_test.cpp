// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/loaded_scene.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace plekton::test::reactions_test {
namespace {

using dynamics::ForceAndMoment;

constexpr double kGravity = 9.81;  // m/s²

/// A sphere at rest on a floor, at (1, 0).
Scene resting_sphere() {
  constexpr double kRadius = 0.1;
  Scene scene;
  scene.materials = {contact::Material{1e6, 0.5, 0.3}};
  scene.planes = {{Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), contact::MaterialId{0}}};
  const double stiffness = 1e6 * kRadius;
  const double mass = 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius * 1000.0;
  scene.add_sphere(Vec3(1, 0, kRadius - mass * kGravity / stiffness), kRadius, 1000.0,
                   contact::MaterialId{0});
  return scene;
}

TEST(PlaneReaction, IsTheWeightOfWhatRestsOnThePlaneWithItsMoment) {
  LoadedSimulation simulation = simulation_of(resting_sphere(), 1e-4, Vec3(0, 0, -kGravity));
  simulation.step();
  const double weight = simulation.properties().mass[0] * kGravity;

  const ForceAndMoment reaction = simulation.plane_reaction(0);

  EXPECT_NEAR(reaction.force[2], -weight, 1e-9 * weight);
  EXPECT_NEAR(reaction.moment[1], weight, 1e-9 * weight);  // arm 1 m along x
}

TEST(SupportReaction, IsWhatAHeldLumpHangsOnAndItsWeight) {
  Scene scene;
  scene.materials = {contact::Material{1e6, 0.5, 0.3}};
  const NodeId support = add_lump(scene, Vec3(0, 0, 0));
  const NodeId end = add_lump(scene, Vec3(2, 0, 0));
  scene.properties.held[0] = dynamics::Held::everything;
  scene.add_beam(support, end, dynamics::circular_section(0.05, 1e9, 0.3), 1000.0);
  dynamics::NodalForce load;
  load.nodes = {end};
  load.force = Vec3(0, 0, -5.0);
  scene.loads.forces = {load};
  LoadedSimulation simulation = simulation_of(std::move(scene), 1e-6, Vec3(0, 0, -kGravity));
  // Clamped and loaded at the start, the bond does not act yet: the support bears its node alone.
  simulation.step();
  const std::vector<NodeId> nodes{support, end};
  const double weight = simulation.properties().mass[0] * kGravity;

  const ForceAndMoment reaction = simulation.support_reaction(nodes, Vec3(1, 0, 0));

  // The free end is not supported, however it is loaded.
  EXPECT_NEAR(reaction.force[2], -weight, 1e-12 * weight);
  EXPECT_NEAR(reaction.moment[1], -weight, 1e-12 * weight);  // arm -1 m along x
}

TEST(SupportReaction, LeavesOutTheAxesThatAreFree) {
  Scene scene;
  scene.materials = {contact::Material{1e6, 0.5, 0.3}};
  const NodeId node = add_lump(scene, Vec3::Zero());
  scene.properties.held[0] = dynamics::Held::along_z;
  dynamics::NodalForce load;
  load.nodes = {node};
  load.force = Vec3(3.0, 0, 4.0);
  load.torque = Vec3(1.0, 0, 0);
  scene.loads.forces = {load};
  LoadedSimulation simulation = simulation_of(std::move(scene), 1e-4);
  simulation.step();

  const ForceAndMoment reaction =
      simulation.support_reaction(std::vector<NodeId>{node}, Vec3::Zero());

  EXPECT_EQ(reaction.force, Vec3(0, 0, 4.0));
  EXPECT_EQ(reaction.moment, Vec3::Zero());
}

TEST(UnbalancedForceRatio, IsSmallAtRestOneInFreeLoadAndZeroWhereNothingActs) {
  LoadedSimulation at_rest = simulation_of(resting_sphere(), 1e-4, Vec3(0, 0, -kGravity));
  LoadedSimulation weightless = simulation_of(resting_sphere(), 1e-4);
  Scene apart = resting_sphere();
  apart.state.position[0][2] = 1.0;
  LoadedSimulation falling = simulation_of(apart, 1e-4, Vec3(0, 0, -kGravity));
  LoadedSimulation floating = simulation_of(apart, 1e-4);
  for (LoadedSimulation* simulation : {&at_rest, &weightless, &falling, &floating})
    simulation->step();

  EXPECT_LT(at_rest.unbalanced_force_ratio(), 1e-9);
  EXPECT_NEAR(weightless.unbalanced_force_ratio(), 1.0, 1e-12);  // the contact alone
  EXPECT_EQ(falling.unbalanced_force_ratio(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(floating.unbalanced_force_ratio(), 0.0);
}

/// A node moved from the middle of two equal bars: one pulls it and the other pushes it with F, so
/// that 2 F are left on it, and each bar carries F. Bars are asked where the node is after the step,
/// (omega dt)² / 2 = 2.5e-6 of its way nearer to the middle than where the resultant was.
TEST(UnbalancedForceRatio, CountsWhatBondsCarry) {
  Scene scene;
  for (const double x : {-0.2, 0.0, 0.2}) scene.add_node(Vec3(x, 0, 0), dynamics::Held::everything);
  scene.properties.held[1] =
      dynamics::Held::rotation | dynamics::Held::along_y | dynamics::Held::along_z;
  for (const int a : {0, 1})
    scene.add_beam(NodeId{a}, NodeId{a + 1}, dynamics::bar_section(0.01, 1e8), 1000.0);
  scene.state.position[1].x() = 1e-4;
  LoadedSimulation simulation = simulation_of(std::move(scene), 1e-6);
  simulation.step();

  EXPECT_NEAR(simulation.unbalanced_force_ratio(), 2.0 * (1.0 + 2.5e-6), 1e-9);
}

}  // namespace
}  // namespace plekton::test::reactions_test
