// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/state/rigid_nodes.hpp"

#include "dynamics/model/scene.hpp"
#include "dynamics/stiffness/nodal_stiffness.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace plekton::dynamics::rigid_nodes_test {
namespace {

/// A body of two nodes on the x axis.
Scene bar(Held held = Held::nothing) {
  Scene scene;
  scene.add_node(Vec3(-1, 0, 0));
  scene.add_node(Vec3(1, 0, 0));
  MassProperties mass{2.0, Vec3::Zero(), Mat3::Identity()};
  mass.inertia.diagonal() = Vec3(0.5, 1.0, 4.0);
  scene.add_rigid_body(std::vector{NodeId{0}, NodeId{1}}, mass, held);
  return scene;
}

RigidNodes nodes_of(const Scene& scene) {
  return {scene.rigid_bodies, scene.state, scene.properties};
}

TEST(RigidNodes, KnowWhoFollowsWhom) {
  const Scene scene = bar();
  const RigidNodes rigid = nodes_of(scene);

  EXPECT_EQ(rigid.mover_of(NodeId{0}), NodeId{2});
  EXPECT_EQ(rigid.mover_of(NodeId{2}), NodeId{2});
  EXPECT_EQ(rigid.body_at(NodeId{2}), 0);
  EXPECT_EQ(rigid.body_at(NodeId{0}), -1);
  EXPECT_EQ(rigid.lever_of(NodeId{1}), Vec3(1, 0, 0));
  EXPECT_EQ(RigidNodes().mover_of(NodeId{7}), NodeId{7});
}

// A push along z at x = 1 moves the point by 1 / m, and by 1 / I_y through the turn.
TEST(RigidNodes, MoveAPointByMassAndInertia) {
  const Scene scene = bar();

  const Mat3 mobility = nodes_of(scene).point_mobility(0, Vec3(1, 0, 0));

  EXPECT_NEAR(mobility(2, 2), 1.0 / 2.0 + 1.0 / 1.0, 1e-15);
  EXPECT_NEAR(mobility(1, 1), 1.0 / 2.0 + 1.0 / 4.0, 1e-15);
  EXPECT_NEAR(mobility(0, 0), 1.0 / 2.0, 1e-15);
}

TEST(RigidNodes, DoNotMoveAlongWhatIsHeld) {
  const Scene scene = bar(Held::along_z | Held::about_y);

  const Mat3 mobility = nodes_of(scene).point_mobility(0, Vec3(1, 0, 0));

  EXPECT_EQ(mobility(2, 2), 0.0);
  EXPECT_NEAR(mobility(1, 1), 1.0 / 2.0 + 1.0 / 4.0, 1e-15);
}

// Of a single spring at the end of the bar the bound is exact: omega² = k (1 / m + 1 / I_y).
TEST(RigidNodes, LimitTheStepOfASpringAtTheirEnd) {
  const Scene scene = bar();
  const RigidNodes rigid = nodes_of(scene);
  NodalStiffness stiffness(scene.state.size(), &scene.properties, &rigid);

  stiffness.add_to_wall(NodeId{1}, {Vec3::UnitZ(), 600.0, 0.0, 0.1, 0.0});
  const CriticalStep step = stiffness.critical_step(scene.properties);

  EXPECT_NEAR(step.dt, 2.0 / std::sqrt(600.0 * 1.5), 1e-12);
  EXPECT_EQ(step.node, NodeId{2});
}

// A push through the centre of a body that can only turn moves nothing; rounding made it a square
// root of less than 0, and a time step that was no number.
TEST(RigidNodes, AreNotMovedThroughTheirCentreWhereTheyCanOnlyTurn) {
  Scene scene = bar(Held::translation);
  test::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    scene.state.orientation[2] = Quat(random.rotation());
    const RigidNodes rigid = nodes_of(scene);
    const NodalStiffness stiffness(scene.state.size(), &scene.properties, &rigid);
    const Vec3 normal = random.direction();

    const double moved = stiffness.mobility_of({NodeId{2}, 1.0, 0.3}, normal).normal;

    EXPECT_GE(moved, 0.0) << i;
    EXPECT_LE(moved, 1e-7) << i;
  }
}

// Two springs at both ends: the body turns about y against 2 k, and moves against 2 k.
TEST(RigidNodes, AddUpWhatHoldsThemInSixDirections) {
  const Scene scene = bar();
  const RigidNodes rigid = nodes_of(scene);
  NodalStiffness stiffness(scene.state.size(), &scene.properties, &rigid);

  for (const NodeId end : {NodeId{0}, NodeId{1}})
    stiffness.add_to_wall(end, {Vec3::UnitZ(), 600.0, 0.0, 0.1, 0.0});

  EXPECT_NEAR(stiffness.critical_step(scene.properties).dt, 2.0 / std::sqrt(2.0 * 600.0), 1e-12);
}

}  // namespace
}  // namespace plekton::dynamics::rigid_nodes_test
