// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/wall_collisions.hpp"

#include <gtest/gtest.h>

#include <cmath>

/// The step that follows what falls on walls: omega dt = 1/2 for the energy of what is about to
/// touch or to part.
namespace plekton::test::wall_collisions_test {
namespace {

using dynamics::ContactSprings;
using dynamics::ContactStiffness;
using dynamics::Held;
using dynamics::NodeProperties;
using dynamics::Vec3;
using geometry::NodeId;

constexpr double kStiffness = 30.0;  // N/m
constexpr double kMass = 2.0;        // kg

/// Balls beside each other that follow no rigid body, over walls below them.
struct Falling {
  dynamics::NodeState state;
  NodeProperties properties{{kMass, 0.5, 0.01}, {1.0, 1.0, 1.0}, {3, Held::nothing}};
  dynamics::RigidNodes rigid;
  ContactSprings springs{&rigid};

  Falling() { state.position = state.velocity = state.angular_velocity = {3, Vec3::Zero()}; }
  void add(NodeId node, double overlap, const Vec3& normal = Vec3::UnitZ(), double speed = 0.0) {
    ContactStiffness contact{normal, kStiffness, 0.0, 0.1, 0.1};
    contact.overlap = overlap;
    contact.wall_speed = speed;
    springs.add_to_wall(node, contact);
  }
  double step() { return dynamics::WallCollisions(rigid).step(springs, state, properties); }
};

TEST(WallCollisions, OfOneBallAreFollowedInHalfOfTheInverseOfItsFrequency) {
  Falling coming;
  coming.add(NodeId{0}, 0.0);
  coming.state.velocity[0] = Vec3(3.0, 0.0, -1.0);
  Falling pushed;  // a wall that comes
  pushed.add(NodeId{0}, 0.0, Vec3::UnitZ(), 1.0);
  const double omega = std::sqrt(kStiffness / kMass);

  EXPECT_NEAR(coming.step(), 0.5 / omega, 1e-12);
  EXPECT_NEAR(pushed.step(), 0.5 / omega, 1e-12);
}

TEST(WallCollisions, OfManyBallsAreFollowedByTheMeanOfTheirEnergies) {
  Falling both;
  both.add(NodeId{0}, 0.0);
  both.add(NodeId{1}, 0.0);
  both.state.velocity[0] = both.state.velocity[1] = Vec3(0.0, 0.0, -1.0);
  const double mean = (kMass * kStiffness / kMass + 0.5 * kStiffness / 0.5) / (kMass + 0.5);

  EXPECT_NEAR(both.step(), 0.5 / std::sqrt(mean), 1e-12);
}

TEST(WallCollisions, InACornerOfTwoWallsThatAreHardlyAnAngleApartCountBoth) {
  Falling corner;
  corner.add(NodeId{0}, 0.0, Vec3(0.01, 0.0, 1.0).normalized());
  corner.add(NodeId{0}, 0.0, Vec3(-0.01, 0.0, 1.0).normalized());
  corner.state.velocity[0] = Vec3(0.0, 0.0, -1.0);
  const double normal = 1.0 / 1.0001;  // squared share of the normal in the fall

  EXPECT_NEAR(corner.step(), 0.5 / std::sqrt(2.0 * normal * kStiffness / kMass), 1e-12);
}

TEST(WallCollisions, AreNoneWhereBallsRestDeeperThanTheirMotionReaches) {
  Falling resting;
  resting.add(NodeId{0}, 1e-3);
  EXPECT_TRUE(std::isinf(resting.step()));
  resting.state.velocity[0].z() = 0.9e-3 * std::sqrt(kStiffness / kMass);
  EXPECT_TRUE(std::isinf(resting.step()));
  resting.state.velocity[0].z() = 1.1e-3 * std::sqrt(kStiffness / kMass);
  EXPECT_TRUE(std::isfinite(resting.step()));
}

TEST(WallCollisions, AreFollowedHoweverMuchRestsBesideThem) {
  Falling alone;
  alone.add(NodeId{0}, 0.0);
  alone.state.velocity[0] = Vec3(0.0, 0.0, -1.0);
  Falling beside = alone;
  beside.add(NodeId{1}, 0.1);

  EXPECT_EQ(beside.step(), alone.step());
}

TEST(WallCollisions, AreNoneOfABallThatIsHeldAcrossTheWall) {
  Falling held;
  held.add(NodeId{0}, 0.0);
  held.state.velocity[0] = Vec3(0.0, 0.0, -1.0);
  held.properties.held[0] = Held::along_z;

  EXPECT_TRUE(std::isinf(held.step()));
}

/// A plate of four balls on its corners: k (h^T M^-1 h) of all springs together.
TEST(WallCollisions, OfAPlateThatFallsFlatAreAsFastAsAllItsSpringsMakeThem) {
  dynamics::NodeState state;
  state.position = {Vec3::Zero(), Vec3(1, 1, 0), Vec3(-1, 1, 0), Vec3(-1, -1, 0), Vec3(1, -1, 0)};
  state.velocity = state.angular_velocity = {5, Vec3::Zero()};
  state.orientation = {5, dynamics::Quat::Identity()};
  NodeProperties properties{std::vector<double>(5, kMass), std::vector<double>(5, 1.0),
                            std::vector<Held>(5, Held::nothing)};
  dynamics::RigidBody plate;
  plate.node = NodeId{0};
  plate.nodes = {NodeId{1}, NodeId{2}, NodeId{3}, NodeId{4}};
  plate.moments = Vec3(0.4, 0.4, 0.7);
  const std::vector<dynamics::RigidBody> bodies{plate};
  const dynamics::RigidNodes rigid(bodies, state, properties);
  ContactSprings springs(&rigid);
  for (const NodeId node : plate.nodes)
    springs.add_to_wall(node, ContactStiffness{Vec3::UnitZ(), kStiffness, 0.0, 0.1, 0.1});
  dynamics::WallCollisions walls(rigid);

  state.velocity[0].z() = -1.0;
  EXPECT_NEAR(walls.step(springs, state, properties), 0.5 / std::sqrt(4.0 * kStiffness / kMass),
              1e-12);
  state.velocity[0].z() = 0.0;
  state.angular_velocity[0].x() = 1.0;  // rocking: the sum of k y² over the moment
  EXPECT_NEAR(walls.step(springs, state, properties), 0.5 / std::sqrt(4.0 * kStiffness / 0.4),
              1e-12);
}

}  // namespace
}  // namespace plekton::test::wall_collisions_test
