// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/carry_over/carried_holds.hpp"

#include "dynamics/model/scene_figures.hpp"
#include "dynamics/state/rigid_nodes.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace plekton::dynamics::carried_holds_test {
namespace {

constexpr double kMass = 3.0;  // kg

/// A node that moves and turns about all axes.
Scene moving_node(Held held) {
  Scene scene;
  scene.add_node(Vec3::Zero(), held);
  scene.properties.mass[0] = kMass;
  scene.properties.inertia[0] = 1.0;
  scene.state.velocity[0] = Vec3(1, 2, 3);
  scene.state.angular_velocity[0] = Vec3(4, 5, 6);
  return scene;
}

/// The node in a scene that goes on from one before.
const NodeState& carried(const Scene& before, Scene& now) {
  RigidBodies bodies({}, now.state);
  follow_holds(before, {0}, now, bodies);
  return now.state;
}

TEST(CarriedHolds, StopWhatIsHeldFromNowOn) {
  const Scene before = moving_node(Held::along_x);
  Scene now = moving_node(Held::along_x | Held::along_z | Held::about_y);
  const NodeState& state = carried(before, now);
  EXPECT_EQ(state.velocity[0], Vec3(1, 2, 0));  // along x it was held, and moved, before
  EXPECT_EQ(state.angular_velocity[0], Vec3(4, 0, 6));
}

TEST(CarriedHolds, ThatAreLetGoMoveOn) {
  const Scene before = moving_node(Held::everything);
  Scene now = moving_node(Held::nothing);
  EXPECT_EQ(carried(before, now).velocity[0], Vec3(1, 2, 3));
}

TEST(CarriedHolds, StopWhatALoadMovedAndTheSceneHolds) {
  Scene before = moving_node(Held::nothing);
  before.loads.motions.push_back(
      {.nodes = {NodeId{0}}, .held = Held::translation, .velocity = Vec3(1, 2, 3)});
  before = held_as_prescribed(std::move(before));
  Scene now = moving_node(Held::translation);
  EXPECT_EQ(carried(before, now).velocity[0], Vec3::Zero());
}

TEST(CarriedHolds, LetABodyTurnAsItMovesWhereItIsHeldInAnotherWay) {
  Scene before = moving_node(Held::nothing);
  const std::vector<NodeId> nodes{NodeId{0}};
  const MassProperties mass{kMass, Vec3::Zero(), Mat3(Vec3(1, 2, 3).asDiagonal())};
  before.add_rigid_body(nodes, mass);
  before.state.angular_velocity[1] = Vec3(4, 5, 6);
  Scene now = before;
  now.properties.held[1] = now.properties.held[1] | Held::about_x;
  RigidBodies bodies(now.rigid_bodies, now.state);
  bodies.start(now.state, now.properties);

  follow_holds(before, {0, 1}, now, bodies);

  EXPECT_EQ(now.state.angular_velocity[1], Vec3(0, 5, 6));
  const Vec3 momentum = bodies.angular_momentum(0);
  EXPECT_NEAR(momentum.x(), 0.0, 1e-14);
  EXPECT_DOUBLE_EQ(momentum.y(), 2.0 * 5.0);
  EXPECT_DOUBLE_EQ(momentum.z(), 3.0 * 6.0);
}

/// J, what starts late has beyond what the leapfrog takes it for, with an acceleration of 1 m/s²
/// along each axis and a next drift of 2 s: 1/8 m (1 m/s² 2 s)² for each axis that begins.
double energy_of_starts(const Scene& before, const std::vector<std::int32_t>& places, Scene now) {
  LateStarts starts;
  add_late_starts(before, places, now, starts);
  if (starts.empty()) return 0.0;
  NodeForces forces(now.state.size());
  const RigidNodes rigid(now.rigid_bodies, now.state, now.properties);
  RigidBodies bodies(now.rigid_bodies, now.state);
  return starts.put_back({0.0, 2.0},
                         {now.state, forces, now.properties, rigid, bodies, Vec3::Ones()});
}

TEST(LateStarts, AreOfWhatWasHeldAndIsFree) {
  constexpr double kOfAnAxis = kMass / 8.0 * 4.0;
  const Scene held = moving_node(Held::translation);
  EXPECT_DOUBLE_EQ(energy_of_starts(held, {0}, moving_node(Held::along_x)), 2.0 * kOfAnAxis);
  EXPECT_EQ(energy_of_starts(held, {0}, held), 0.0);
  EXPECT_EQ(energy_of_starts(moving_node(Held::nothing), {0}, moving_node(Held::nothing)), 0.0);
}

TEST(LateStarts, AreOfNodesThatWereNotThere) {
  constexpr double kOfAnAxis = kMass / 8.0 * 4.0;
  EXPECT_DOUBLE_EQ(energy_of_starts({}, {}, moving_node(Held::along_x)), 2.0 * kOfAnAxis);
  Scene absent = moving_node(Held::nothing);
  absent.is_absent = {true};
  EXPECT_DOUBLE_EQ(energy_of_starts(absent, {0}, moving_node(Held::nothing)), 3.0 * kOfAnAxis);
  EXPECT_EQ(energy_of_starts(moving_node(Held::nothing), {0}, absent), 0.0);
}

}  // namespace
}  // namespace plekton::dynamics::carried_holds_test
