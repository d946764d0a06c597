// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/stiffness/contact_springs.hpp"

#include <gtest/gtest.h>

#include <cmath>

/// The steps that follow collisions with surfaces, omega dt = 1/2 for the energy in them, and centres
/// that go through cores.
namespace plekton::test::contact_springs_test {
namespace {

using dynamics::ContactSprings;
using dynamics::ContactStiffness;
using dynamics::Held;
using dynamics::NodeProperties;
using dynamics::Vec3;
using geometry::NodeId;

struct Collisions {
  dynamics::NodeState state;
  NodeProperties properties{{2.0, 0.5, 0.01}, {1.0, 1.0, 1.0}, {3, Held::nothing}};
  ContactSprings springs;

  Collisions() { state.position = state.velocity = state.angular_velocity = {3, Vec3::Zero()}; }
  void add(NodeId node, double stiffness, double overlap, double core_force = 0.0) {
    ContactStiffness contact{Vec3::UnitZ(), stiffness, 0.0, 0.1, 0.1};
    contact.overlap = overlap;
    contact.core_force = core_force;
    springs.add_on_surface(NodeId{0}, geometry::core_point(node), contact);
  }
  double step() const { return springs.collision_step(state, properties); }
  double crossing_step() const { return springs.crossing_step(state, properties); }
  double ending_step() const { return springs.ending_step(state, properties); }
};

TEST(CollisionStep, OfOneContactIsHalfOfTheInverseOfItsFrequency) {
  Collisions pressed;
  pressed.add(NodeId{1}, 30.0, 0.001);
  Collisions coming;
  coming.add(NodeId{1}, 30.0, 0.0);
  coming.state.velocity[0] = Vec3(3.0, 0.0, -1.0);
  const double omega = std::sqrt(30.0 * (1.0 / 2.0 + 1.0 / 0.5));

  EXPECT_NEAR(pressed.step(), 0.5 / omega, 1e-12);
  EXPECT_NEAR(coming.step(), 0.5 / omega, 1e-12);
}

// E = 1/2 k overlap² = 15 and 60 uJ, omega² = k (1/2 + 1/m).
TEST(CollisionStep, OfManyIsThatOfTheMeanByTheirEnergy) {
  Collisions both;
  both.add(NodeId{1}, 30.0, 0.001);
  both.add(NodeId{2}, 30.0, 0.002);
  const double mean = (15.0 * 30.0 * (0.5 + 2.0) + 60.0 * 30.0 * (0.5 + 100.0)) / 75.0;

  EXPECT_NEAR(both.step(), 0.5 / std::sqrt(mean), 1e-12);
}

TEST(CollisionStep, IsInfiniteWhereNothingCollides) {
  Collisions still;
  EXPECT_TRUE(std::isinf(still.step()));
  still.add(NodeId{1}, 30.0, 0.0);
  EXPECT_TRUE(std::isinf(still.step()));
}

// E = 1/2 30 N/m (0.1 m)² + 1/2 (1 m/s)² 0.4 kg = 0.35 J.
TEST(CrossingStep, TakesTheForceAtTheCoreOverASixteenthOfTheEnergy) {
  Collisions crossing;
  crossing.state.velocity[0] = Vec3(3.0, 0.0, 0.25);
  crossing.state.velocity[1] = Vec3(0.0, 5.0, -0.75);
  crossing.add(NodeId{1}, 30.0, 0.1, 3.6);

  EXPECT_NEAR(crossing.crossing_step() * 3.6 * 1.0, 0.35 / 16.0, 1e-15);
}

TEST(CrossingStep, IsInfiniteWhereNothingComesNearerToACore) {
  Collisions far;
  far.state.velocity[0] = Vec3(0.0, 0.0, 1.0);
  far.add(NodeId{1}, 30.0, 0.1);
  Collisions parting;
  parting.state.velocity[0] = Vec3(0.0, 0.0, -1.0);
  parting.add(NodeId{1}, 30.0, 0.1, 3.6);

  EXPECT_TRUE(std::isinf(far.crossing_step()));
  EXPECT_TRUE(std::isinf(parting.crossing_step()));
}

// A ball that is moved as told comes to a held node: it has no energy that could be lost.
TEST(CrossingStep, IsInfiniteWhereNothingIsFree) {
  Collisions moved;
  moved.properties.held = {3, Held::everything};
  moved.state.velocity[0] = Vec3(0.0, 0.0, 1.0);
  moved.add(NodeId{1}, 30.0, 0.1, 3.6);

  EXPECT_TRUE(std::isinf(moved.crossing_step()));
}

// Both have 1/2 (1 m/s)² 0.4 kg of motion; the second one stores 1/2 30 N/m (0.1 m)² besides.
TEST(EndingStep, TakesWhatMotionHasMoreThanIsStored) {
  Collisions ending;
  ending.state.velocity[0] = Vec3(3.0, 0.0, 0.25);
  ending.state.velocity[1] = Vec3(0.0, 5.0, -0.75);
  ending.add(NodeId{1}, 30.0, 0.0);
  const double omega = std::sqrt(30.0 / 0.4);
  EXPECT_NEAR(ending.ending_step(), 0.125 / omega, 1e-15);

  ending.add(NodeId{1}, 30.0, 0.1);

  EXPECT_NEAR(ending.ending_step(), 0.125 / omega * std::sqrt(0.55 / std::hypot(0.2, 0.05)), 1e-15);
}

// What goes up in one goes down in another, unless all begin at once.
TEST(EndingStep, IsLongerWhereManyShareInTheEnergy) {
  Collisions ending;
  ending.state.velocity[0] = Vec3(0.0, 0.0, 1.0);
  const double omega = std::sqrt(30.0 / 0.4);
  for (int i = 0; i < 16; ++i) ending.add(NodeId{1}, 30.0, 0.0);
  EXPECT_NEAR(ending.ending_step(), 0.25 / omega, 1e-15);

  for (int i = 16; i < 300; ++i) ending.add(NodeId{1}, 30.0, 0.0);

  EXPECT_NEAR(ending.ending_step(), 0.5 / omega, 1e-15);
}

TEST(EndingStep, IsInfiniteWhereMoreIsStoredThanMotionTakes) {
  Collisions pulled;
  pulled.state.velocity[0] = Vec3(0.0, 0.0, 1.0);
  pulled.add(NodeId{1}, 50.0, 0.1);

  EXPECT_TRUE(std::isinf(pulled.ending_step()));
}

}  // namespace
}  // namespace plekton::test::contact_springs_test
