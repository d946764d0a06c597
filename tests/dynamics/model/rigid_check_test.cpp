// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/rigid_check.hpp"

#include "tests/support/loaded_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace plekton::dynamics::rigid_check_test {
namespace {

using geometry::NodeId;
using test::problems_of;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

MassProperties mass_of_one() {
  return {1.0, Vec3::Zero(), Mat3::Identity()};
}

/// Two nodes that follow node 2.
Scene body() {
  Scene scene;
  scene.add_node(Vec3(-1, 0, 0));
  scene.add_node(Vec3(1, 0, 0));
  scene.add_rigid_body(std::vector{NodeId{0}, NodeId{1}}, mass_of_one());
  return scene;
}

TEST(RigidCheck, FindsNothingWrongWithASoundBody) {
  EXPECT_THAT(problems_of(body()), IsEmpty());
}

TEST(RigidCheck, AsksForMassWhereABodyIsFree) {
  Scene scene;
  scene.add_node(Vec3::Zero());
  scene.add_rigid_body(std::vector{NodeId{0}}, {});

  EXPECT_THAT(problems_of(scene), HasSubstr("rigid body 0: its mass is 0; give it a volume and a "
                                            "density, or its mass and inertia"));
  scene.properties.held.back() = scene.properties.held.back() | Held::everything;
  EXPECT_THAT(problems_of(scene), IsEmpty());
}

TEST(RigidCheck, RefusesANodeOfTwoBodies) {
  Scene scene = body();
  scene.add_rigid_body(std::vector{NodeId{1}}, mass_of_one());

  EXPECT_THAT(problems_of(scene), HasSubstr("rigid body 1: node 1 follows rigid body 0 already"));
}

TEST(RigidCheck, NamesNodesThatAreNotThere) {
  Scene scene = body();
  scene.rigid_bodies[0].nodes.push_back(NodeId{7});
  EXPECT_THAT(problems_of(scene), HasSubstr("rigid body 0: there is no node 7, only 3 nodes"));

  scene.rigid_bodies[0].nodes.clear();
  scene.rigid_bodies[0].node = NodeId{-1};
  EXPECT_THAT(problems_of(scene), AllOf(HasSubstr("rigid body 0: has no nodes"),
                                        HasSubstr("rigid body 0: there is no node -1")));
}

TEST(RigidCheck, NamesTheCallThatMakesABodyWhereOneWasPutTogetherByHand) {
  Scene scene = body();
  scene.properties.held[0] = Held::nothing;
  scene.rigid_bodies[0].node = NodeId{1};

  EXPECT_THAT(problems_of(scene),
              AllOf(HasSubstr("rigid body 0: node 0 is not held; make the body with "
                              "Scene::add_rigid_body"),
                    HasSubstr("rigid body 0: node 1 is no reference node; make the body with "
                              "Scene::add_rigid_body")));
}

TEST(RigidCheck, RefusesABondWithinABody) {
  Scene scene = body();
  scene.add_beam(NodeId{0}, NodeId{1}, circular_section(0.01, 1e7, 0.3), 0.0);

  EXPECT_THAT(problems_of(scene), HasSubstr("bond 0: lies within rigid body 0"));
}

TEST(RigidCheck, RefusesALoadOnAnInnerNode) {
  Scene scene = body();
  scene.loads.forces.push_back({{NodeId{1}}, Vec3::UnitX(), Vec3::Zero(), {}});

  EXPECT_THAT(problems_of(scene),
              HasSubstr("nodal force 0: node 1 follows rigid body 0; load the reference node of "
                        "that, 2"));
}

}  // namespace
}  // namespace plekton::dynamics::rigid_check_test
