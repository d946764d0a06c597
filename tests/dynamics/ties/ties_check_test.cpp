// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/ties/ties_check.hpp"

#include "tests/support/loaded_scene.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace plekton::test::ties_check_test {
namespace {

using dynamics::CablePlace;
using dynamics::FixedPoint;
using dynamics::material_point;
using dynamics::MaterialPoint;
using dynamics::Tie;
using testing::HasSubstr;

/// Four lumps, the last three of them a cable.
Scene lumps() {
  Scene scene;
  for (int i = 0; i < 4; ++i) add_lump(scene, Vec3(i, 0.0, 0.0));
  scene.cables.push_back({{NodeId{1}, NodeId{2}, NodeId{3}}, false});
  return scene;
}

Tie on_cable() {
  return {.node = NodeId{0}, .to = CablePlace{0, 1, 0.5}, .stiffness = 1.0, .pushes = false};
}

/// What is wrong with a scene with one tie.
std::string problems_with(const Tie& tie) {
  Scene scene = lumps();
  scene.ties.push_back(tie);
  return problems_of(scene);
}

TEST(TiesCheck, TakesTiesOfEveryKind) {
  EXPECT_EQ(problems_with(on_cable()), "");
  EXPECT_EQ(problems_with({.node = NodeId{0}, .to = material_point(NodeId{2}), .stiffness = 1.0}),
            "");
  EXPECT_EQ(problems_with({.node = NodeId{0}, .to = FixedPoint{Vec3::Zero()}, .stiffness = 1.0}),
            "");
}

TEST(TiesCheck, RefusesWhatIsNotThere) {
  EXPECT_THAT(problems_with({.node = NodeId{7}, .to = FixedPoint{Vec3::Zero()}, .stiffness = 1.0}),
              HasSubstr("tie 0: there is no node 7, only 4 nodes"));
  EXPECT_THAT(
      problems_with({.node = NodeId{0}, .to = material_point(NodeId{-1}), .stiffness = 1.0}),
      HasSubstr("tie 0: there is no node -1, only 4 nodes"));
  Tie tie = on_cable();
  tie.to = CablePlace{1, 0, 0.0};
  EXPECT_THAT(problems_with(tie), HasSubstr("tie 0: there is no cable 1, only 1 cables"));
  tie.to = CablePlace{0, 2, 0.0};
  EXPECT_THAT(problems_with(tie), HasSubstr("starts on a segment that its cable does not have"));
  tie.to = CablePlace{0, 1, 1.5};
  EXPECT_THAT(problems_with(tie), HasSubstr("along is 0 to 1"));
}

TEST(TiesCheck, RefusesNumbersThatCannotBe) {
  const auto problems = [](double Tie::*number, double value) {
    Tie tie = on_cable();
    tie.*number = value;
    return problems_with(tie);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(problems(&Tie::stiffness, 0.0), HasSubstr("its stiffness (N/m) must be finite"));
  EXPECT_THAT(problems(&Tie::stiffness, nan), HasSubstr("its stiffness (N/m) must be finite"));
  EXPECT_THAT(problems(&Tie::rest_length, -1.0), HasSubstr("its rest length (m) must be"));
  EXPECT_THAT(problems(&Tie::strength, 0.0), HasSubstr("its strength (N) must be above 0"));
  EXPECT_THAT(problems(&Tie::brake_force, -1.0), HasSubstr("of its brake must be above 0"));
  EXPECT_THAT(problems(&Tie::stroke, nan), HasSubstr("the stroke (m) of its brake"));
  EXPECT_THAT(problems(&Tie::friction, -0.1), HasSubstr("its friction and slip force"));
  EXPECT_THAT(
      problems_with({.node = NodeId{0},
                     .to = MaterialPoint{{NodeId{1}, NodeId{2}, NodeId{1}}, Vec3(0.5, 0.4, 0.0)},
                     .stiffness = 1.0}),
      HasSubstr("and have the sum 1"));
}

TEST(TiesCheck, RefusesWhatDoesNotGoTogether) {
  Tie tie = on_cable();
  tie.pushes = true;
  EXPECT_THAT(problems_with(tie), HasSubstr("only pulls on a cable or with a brake"));
  tie = on_cable();
  tie.brake_force = 1.0;
  EXPECT_THAT(problems_with(tie), HasSubstr("on a cable has no brake; give it a slip force"));
  tie = on_cable();
  tie.node = NodeId{2};
  EXPECT_THAT(problems_with(tie), HasSubstr("ties a node to a cable of its own"));
  tie = {.node = NodeId{0}, .to = material_point(NodeId{0}), .stiffness = 1.0};
  EXPECT_THAT(problems_with(tie), HasSubstr("ties a node to itself"));
  tie.to = FixedPoint{Vec3::Zero()};
  tie.friction = 0.1;
  EXPECT_THAT(problems_with(tie), HasSubstr("slides on a cable only"));
}

// Such a tie has no stiffness, and made the critical step no number.
TEST(TiesCheck, RefusesToTieARigidBodyToItself) {
  Scene scene = lumps();
  scene.cables.clear();
  scene.rigid_bodies = {{NodeId{1}, {NodeId{2}, NodeId{3}}}};
  scene.ties = {{.node = NodeId{2},
                 .to = MaterialPoint{{NodeId{3}, NodeId{1}, NodeId{3}}, Vec3(0.5, 0.5, 0.0)},
                 .stiffness = 1.0}};
  EXPECT_THAT(problems_of(scene), HasSubstr("tie 0: ties a rigid body to itself"));

  scene.ties[0].node = NodeId{0};
  EXPECT_THAT(problems_of(scene), testing::Not(HasSubstr("ties a rigid body to itself")));
}

TEST(TiesCheck, RefusesCablesThatAreNone) {
  Scene scene = lumps();
  scene.cables.push_back({{NodeId{1}}, false});
  scene.cables.push_back({{NodeId{1}, NodeId{2}, NodeId{1}}, false});

  EXPECT_THAT(problems_of(scene), HasSubstr("cable 1: has too few nodes"));
  EXPECT_THAT(problems_of(scene), HasSubstr("cable 2: names a node twice"));
}

}  // namespace
}  // namespace plekton::test::ties_check_test
