// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/fault_finder.hpp"

#include "dynamics/model/scene_figures.hpp"
#include "tests/support/resisting_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plekton::dynamics::fault_finder_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Sign = Divergence::Sign;

constexpr contact::MaterialId kMaterial{0};
constexpr BeamSection kBar{1e6, 1e6, 1e-4, 0.0, 0.0};  // E A = 100 N

/// Asks about nodes of a scene.
struct Finder : test::ResistingScene {
  explicit Finder(Scene of) : ResistingScene(std::move(of)) {}

  FaultFinder finder() { return {resistance(), limits, scene.state, on_nodes, largest, pool}; }
  std::string strongest(Sign sign, NodeId node) {
    return finder().strongest_action({sign, node}, scene.state);
  }
  std::string fault(Sign sign, NodeId node, const Drifts& drifts, const std::string& suspect = "") {
    return finder().fault({sign, node}, drifts, suspect);
  }

  StepLimits limits{resistance()};
  NodeForces on_nodes{scene.state.size()};
  double largest = largest_radius(scene.elements);  ///< m
};

Scene of_nodes(const std::vector<Vec3>& places) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  for (const Vec3& place : places) {
    scene.add_node(place);
    scene.properties.mass.back() = 2.0;
    scene.properties.inertia.back() = 0.1;
  }
  return scene;
}

/// Bars of 1 m along x from node 0 to node 1 and on to node 2, which are stretched to carry 10 and
/// 30 N, and a tie that holds node 1 with 20 N.
Scene stretched_bars() {
  Scene scene = of_nodes({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)});
  scene.add_beam(NodeId{0}, NodeId{1}, kBar, 0.0);
  scene.add_beam(NodeId{1}, NodeId{2}, kBar, 0.0);
  scene.ties = {{.node = NodeId{1},
                 .to = FixedPoint{Vec3(1.1, 3.0, 0)},
                 .stiffness = 10.0,
                 .rest_length = 1.0}};
  scene.state.position[1].x() = 1.1;
  scene.state.position[2].x() = 2.4;
  return scene;
}

TEST(StrongestAction, IsTheElementThatPullsMostOfThoseThatAreLeft) {
  Finder bars(stretched_bars());
  EXPECT_EQ(bars.strongest(Sign::motion, NodeId{0}), "bond 0 (nodes 0, 1) acts on it with 10 N");
  EXPECT_EQ(bars.strongest(Sign::motion, NodeId{1}), "bond 1 (nodes 1, 2) acts on it with 30 N");

  bars.bonds.break_bond(1);

  EXPECT_EQ(bars.strongest(Sign::motion, NodeId{1}), "tie 0 acts on it with 20 N");
  EXPECT_EQ(bars.strongest(Sign::motion, NodeId{2}), "");
}

/// Nodes 1 and 2 as one body, node 3: what acts on one of them acts on the body, and so on the
/// other.
TEST(StrongestAction, OnAPartOfARigidBodyIsThatOnTheWhole) {
  Scene scene = stretched_bars();
  scene.bonds.pop_back();
  scene.ties.clear();
  scene.add_rigid_body(std::vector{NodeId{1}, NodeId{2}},
                       {1.0, Vec3(1.75, 0, 0), Mat3::Identity()});
  Finder body(std::move(scene));

  for (const int node : {1, 2, 3})
    EXPECT_EQ(body.strongest(Sign::motion, NodeId{node}),
              "bond 0 (nodes 0, 1) acts on it with 10 N");
}

/// A beam that is twisted by 0.1 rad at node 1, and a bar there that pulls without a torque.
TEST(StrongestAction, OnWhatSpinsIsTheLargestTorque) {
  Scene scene = stretched_bars();
  BeamSection twisted = kBar;
  twisted.torsion_constant = 1.1e-5;  // G J / L = 10 N m, as long as it is
  scene.bonds[0] = make_beam(NodeId{0}, NodeId{1}, scene.state, twisted);
  scene.state.orientation[1] = Quat(Eigen::AngleAxisd(0.1, Vec3::UnitX()));
  Finder beam(std::move(scene));

  // Twist is linear to the fourth order of the angle.
  const std::string text = beam.strongest(Sign::spin, NodeId{1});
  constexpr std::string_view kBegin = "bond 0 (nodes 0, 1) acts on it with ";
  ASSERT_THAT(text, AllOf(StartsWith(std::string(kBegin)), HasSubstr(" N m")));
  EXPECT_NEAR(std::stod(text.substr(kBegin.size())), 1.0, 1e-4);
}

TEST(StrongestAction, OfASheetIsTheFacetWithItsNodes) {
  Scene scene = of_nodes({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)});
  scene.add_sheet_facet({NodeId{0}, NodeId{1}, NodeId{2}}, {1000.0, 0.0, 0.1, 0.01}, 0.0);
  // Strain (1.2² - 1) / 2 = 0.22 along x, and a pull of E t 0.22 times 1.2 on half of the side.
  scene.state.position[1].x() = 1.2;
  Finder sheet(std::move(scene));

  EXPECT_EQ(sheet.strongest(Sign::energy, NodeId{1}),
            "sheet facet 0 (nodes 0, 1, 2) acts on it with 132 N");
  sheet.sheets.break_facet(0, sheet.scene.state, 0.0);
  EXPECT_EQ(sheet.strongest(Sign::energy, NodeId{1}), "");
}

TEST(StrongestAction, OfAContactNamesTheFeatureThatIsTouched) {
  const auto action_on = [](const Vec3& centre, NodeId node) {
    Scene scene = of_nodes({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)});
    scene.add_facet(NodeId{0}, NodeId{1}, NodeId{2}, 0.01, kMaterial);
    scene.add_sphere(centre, 0.1, 1000.0, kMaterial);
    return Finder(std::move(scene)).strongest(Sign::motion, node);
  };
  const std::string depth = " m, 0.01 m deep, acts on it with ";

  // 0.1 m from the facet, a side and a corner.
  EXPECT_THAT(action_on(Vec3(0.3, 0.3, 0.1), NodeId{3}),
              AllOf(StartsWith("the contact of sphere 0 (node 3) with the facet (nodes 0, 1, 2) of "
                               "structure 0 at ("),
                    HasSubstr(depth)));
  EXPECT_THAT(action_on(Vec3(0.3, -0.06, 0.08), NodeId{1}),
              AllOf(StartsWith("the contact of sphere 0 (node 3) with the edge (nodes 0, 1) of "
                               "structure 0 at ("),
                    HasSubstr(depth)));
  EXPECT_THAT(action_on(Vec3(-0.06, -0.08, 0.0), NodeId{0}),
              AllOf(StartsWith("the contact of sphere 0 (node 3) with node 0 of structure 0 at ("),
                    HasSubstr(depth)));
  EXPECT_EQ(action_on(Vec3(0.3, 0.3, 0.2), NodeId{3}), "");
}

/// A node of 2 kg on a bar of 100 N/m to one that is held: twice that over the mass is below
/// omega² = 100 1/s², so that the critical step is 0.2 s.
Scene on_a_bar() {
  Scene scene = of_nodes({Vec3(0, 0, 0), Vec3(1, 0, 0)});
  scene.add_beam(NodeId{0}, NodeId{1}, kBar, 0.0);
  scene.properties.held = {Held::everything, Held::rotation};
  scene.state.position[1].x() = 1.1;
  return scene;
}

TEST(Fault, IsAGivenStepThatIsTooLongAndNoOther) {
  Finder bar(on_a_bar());
  const auto fault_with = [&](double drift, bool is_chosen) {
    return bar.fault(Sign::energy, NodeId{1}, {drift, drift, is_chosen}, "a suspect");
  };

  EXPECT_EQ(fault_with(0.6, false),
            "bond 0 (nodes 0, 1) acts on it with 10 N; the time step of 0.6 s is 3 of the critical "
            "one: use a smaller time step (or \"auto\")");
  EXPECT_THAT(
      fault_with(0.1, false),
      AllOf(StartsWith("bond 0 (nodes 0, 1) acts on it with 10 N; the time step of 0.1 s is "
                       "0.5 of the critical one and not the cause: look there for"),
            Not(HasSubstr("use a smaller"))));
  EXPECT_THAT(fault_with(0.6, true),
              AllOf(HasSubstr("the time step of 0.6 s is not the cause: with the contacts of now "
                              "that is 0.2 s, so that something there is far stiffer"),
                    Not(HasSubstr("use a smaller"))));
}

/// The state is that after a step: the bar is looked at where its node was before, 0.1 m back.
TEST(Fault, IsLookedForWhereTheForcesWereFoundAndLeavesTheStateAsItIs) {
  Scene scene = on_a_bar();
  scene.state.position[1].x() = 1.3;
  scene.state.velocity[1].x() = 0.2;
  Finder bar(scene);

  EXPECT_THAT(bar.fault(Sign::energy, NodeId{1}, {0.1, 0.5, false}),
              StartsWith("bond 0 (nodes 0, 1) acts on it with 20 N; the time step of 0.5 s is 2.5 "
                         "of the critical one"));
  EXPECT_EQ(bar.scene.state.position, scene.state.position);
  EXPECT_EQ(bar.scene.state.velocity, scene.state.velocity);
}

/// 5 m/s in steps of 1 s, and at most 1 m a step.
TEST(Fault, IsASpeedThatWasThereBeforeTheForces) {
  constexpr Drifts kDrifts{1.0, 1.0, false};
  const std::string given =
      "it was that fast before the step: that was given or is prescribed; use a lower speed, or a "
      "time step below 0.2 s (or \"auto\")";
  const std::string pushed =
      "no contact and no element acts on it, but loads may; as fast as it is, it is followed in "
      "steps below 0.2 s";
  Scene scene = of_nodes({Vec3::Zero()});
  scene.state.velocity[0] = Vec3(5, 0, 0);
  Finder lump(std::move(scene));
  lump.largest = 1.0;
  EXPECT_EQ(lump.fault(Sign::motion, NodeId{0}, kDrifts), given);

  lump.on_nodes.force[0] = Vec3(2.0 * 5.0, 0, 0);  // N, for a second: all of its momentum
  EXPECT_EQ(lump.fault(Sign::motion, NodeId{0}, kDrifts), pushed);
  lump.scene.properties.held[0] = Held::along_x;  // no force moves it then
  EXPECT_EQ(lump.fault(Sign::motion, NodeId{0}, kDrifts), given);

  // It turns by half a turn in pi / 5 s.
  lump.scene.state.angular_velocity[0] = Vec3(0, 5, 0);
  EXPECT_THAT(lump.fault(Sign::spin, NodeId{0}, kDrifts),
              AllOf(StartsWith("it was that fast before"), HasSubstr("below 0.628319 s")));
  lump.on_nodes.torque[0] = Vec3(0, 0.1 * 5.0, 0);
  EXPECT_THAT(
      lump.fault(Sign::spin, NodeId{0}, kDrifts),
      AllOf(StartsWith("no contact and no element acts on it"), HasSubstr("below 0.628319 s")));
}

TEST(Fault, IsWhatActedBeforeWhereEnergyCameFromNowhereAndNothingActsNow) {
  Finder lump(of_nodes({Vec3::Zero()}));

  EXPECT_THAT(lump.fault(Sign::energy, NodeId{0}, {0.1, 0.1, false}, "bond 7 acted"),
              StartsWith("nothing acts on it now; before, bond 7 acted; the time step of 0.1 s is "
                         "not the cause: look there"));
  EXPECT_THAT(lump.fault(Sign::energy, NodeId{0}, {0.1, 0.1, false}),
              StartsWith("no contact and no element acts on it, but loads may; the time step"));
}

}  // namespace
}  // namespace plekton::dynamics::fault_finder_test
