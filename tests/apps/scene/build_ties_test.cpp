// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes that are held where they are on a rigid body.
#include "apps/scene/build_ties.hpp"

#include "apps/scenario/scenario_reader.hpp"
#include "apps/scene/node_set.hpp"
#include "dynamics/scene_check.hpp"
#include "dynamics/simulation.hpp"
#include "tests/support/clumps.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <variant>
#include <vector>

namespace plekton::apps::build_ties_test {
namespace {

using dynamics::MaterialPoint;
using geometry::NodeId;
using testing::HasSubstr;

/// A sheet that flies off a block, held at its side by it; and a grain, which comes last.
constexpr std::string_view kScenario = R"([simulation]
duration = "1 s"
self_contact = false
gravity = [0, 0, 0]
[materials.stuff]
density = "1000 kg/m3"
young_modulus = "10 MPa"
friction_angle = "20 deg"
[[membranes]]
name = "sheet"
shape = { kind = "sheet", width = "0.4 m", length = "0.2 m", cells = [8, 4] }
translate = ["0.3 m", 0, "0.15 m"]
mode = "truss"
thickness = "4 mm"
material = "stuff"
young_modulus = "1 MPa"
density = "1000 kg/m3"
initial_velocity = ["1 m/s", "0.5 m/s", "2 m/s"]
[[rigid_bodies]]
name = "clump"
material = "stuff"
density = "1000 kg/m3"
spheres = [{ centre = [-1, 0, 0], radius = "10 mm" }, { centre = [-1.01, 0, 0], radius = "8 mm" }]
[[rigid_bodies]]
name = "block"
shape = { kind = "box", size = ["0.1 m", "0.2 m", "0.1 m"] }
translate = ["-0.1 m", "-0.1 m", 0]
thickness = "2 mm"
material = "stuff"
density = "500 kg/m3"
angular_velocity = ["2 rad/s", "-3 rad/s", "1 rad/s"]
[[grains]]
name = "grain"
material = "stuff"
radius = "5 mm"
centres = [[0, 0, 3]]
[[ties]]
name = "glue"
from = { membrane = "sheet", nodes = "x_min" }
to = { kind = "body", rigid_body = "block" }
stiffness = "2 kN/m"
)";

BuiltScene built(const std::vector<std::string>& overrides = {}) {
  return build_scene(parse_scenario(kScenario, "case.toml", overrides));
}

std::string error_of(const std::vector<std::string>& overrides) {
  try {
    dynamics::check(built(overrides).scene);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

dynamics::Simulation simulation_of(const BuiltScene& scene) {
  dynamics::SimulationOptions options;
  options.time_step = 2e-5;
  options.motion.gravity = Vec3::Zero();
  return dynamics::Simulation(scene.scene, options);
}

NodeId point_of(const dynamics::Tie& tie) {
  return std::get<MaterialPoint>(tie.to).nodes[0];
}

TEST(BuildTies, HoldNodesWhereTheyAreOnARigidBody) {
  const BuiltScene scene = built();

  EXPECT_EQ(error_of({}), "");
  ASSERT_EQ(scene.scene.ties.size(), 5U);
  EXPECT_EQ(scene.ties[0].longest_gap, 0.0);
  const std::vector<NodeId>& followers = scene.scene.rigid_bodies[0].nodes;
  for (std::size_t i = 0; i < 5; ++i) {
    const dynamics::Tie& tie = scene.scene.ties[i];
    EXPECT_EQ(tie.rest_length, 0.0);
    EXPECT_EQ(scene.scene.state.position[index_of(point_of(tie))],
              scene.scene.state.position[index_of(tie.node)]);
    EXPECT_EQ(point_of(tie), followers[followers.size() - 5 + i]);
  }
}

/// Grains that a stage adds come after all that is there.
TEST(BuildTies, AddTheirNodesBeforeTheGrains) {
  const BuiltScene scene = built();

  const NodeId grain = scene.scene.elements.spheres.back().nodes[0];
  EXPECT_EQ(index_of(grain), scene.scene.state.size() - 1);
  EXPECT_EQ(scene.scene.state.position.back(), Vec3(0, 0, 3));
}

/// What a tie does to the body is what it does to its node, with the opposite sign, and about any
/// point.
TEST(BuildTies, PullTheBodyWithTheForcesAndMomentsOfTheSheet) {
  auto simulation = simulation_of(built());

  double largest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    simulation.step();
    const dynamics::Ties& ties = simulation.ties();
    dynamics::NodeForces forces(simulation.state().size());
    const std::vector<Vec3> x = simulation.force_positions();
    ties.add_forces(forces);
    Vec3 on_body = Vec3::Zero(), moment_on_body = Vec3::Zero();
    Vec3 on_sheet = Vec3::Zero(), moment_on_sheet = Vec3::Zero();
    for (std::size_t t = 0; t < ties.size(); ++t) {
      const std::size_t node = index_of(ties.tie(t).node), point = index_of(point_of(ties.tie(t)));
      on_sheet += forces.force[node];
      moment_on_sheet += x[node].cross(forces.force[node]);
      on_body += forces.force[point];
      moment_on_body += x[point].cross(forces.force[point]);
    }
    largest = std::max(largest, on_sheet.norm());
    // Each of 10 terms is rounded once, within a metre of the origin.
    const double rounding = 40.0 * 2.2e-16 * (on_sheet.norm() + 1.0);
    EXPECT_LT((on_body + on_sheet).norm(), rounding);
    EXPECT_LT((moment_on_body + moment_on_sheet).norm(), rounding);
    const Vec3 centre = x[index_of(simulation.scene().rigid_bodies[0].node)];
    EXPECT_LT((simulation.rigid_bodies().gathered_force(0) - on_body).norm(), rounding);
    EXPECT_LT(
        (simulation.rigid_bodies().gathered_torque(0) - (moment_on_body - centre.cross(on_body)))
            .norm(),
        rounding);
  }

  EXPECT_GT(largest, 1.0);  // N
}

TEST(BuildTies, KeepTheMomentumOfAFreeBodyWithASheet) {
  auto simulation = simulation_of(built());
  const test::Momenta before = test::momenta_of(simulation);
  const double start = simulation.state().velocity[index_of(built().rigid_bodies[0].node)].norm();

  for (int i = 0; i < 20'000; ++i) simulation.step();

  const test::Momenta after = test::momenta_of(simulation);
  const Vec3 velocity =
      simulation.state().velocity[index_of(simulation.scene().rigid_bodies[0].node)];
  EXPECT_EQ(start, 0.0);
  EXPECT_GT(velocity.norm(), 0.1);  // m/s: the sheet takes the block along
  EXPECT_LT((after.linear - before.linear).norm(), 1e-10 * before.size);
  EXPECT_LT((after.angular - before.angular).norm(), 1e-10 * before.size);  // times a metre
  EXPECT_LT(std::abs(simulation.energy().closure_error()), 1e-3 * simulation.energy().turnover());
}

TEST(BuildTies, BreakAtTheirStrengthAndLetTheBodyGo) {
  auto simulation = simulation_of(built({"ties.glue.strength=0.5 N"}));
  const std::size_t body = index_of(simulation.scene().rigid_bodies[0].node);

  while (simulation.ties().broken() < simulation.ties().size() && simulation.time() < 0.5)
    simulation.step();
  simulation.step();
  const Vec3 velocity = simulation.state().velocity[body];
  for (int i = 0; i < 100; ++i) simulation.step();

  EXPECT_EQ(simulation.ties().broken(), 5U);
  EXPECT_EQ(simulation.state().velocity[body], velocity);
}

/// A body that is moved and turned takes the places along, and the nodes with them.
TEST(BuildTies, FollowABodyThatIsMoved) {
  auto simulation = simulation_of(built(
      {"rigid_bodies.block.hold=xyz", "rigid_bodies.block.hold_rotation=xyz",
       "rigid_bodies.block.velocity=[0.2, 0, 0]", "rigid_bodies.block.angular_velocity=[0, 0, 3]",
       "membranes.sheet.initial_velocity=[0, 0, 0]"}));
  const std::vector<Vec3> start = simulation.state().position;
  const std::size_t body = index_of(simulation.scene().rigid_bodies[0].node);

  while (simulation.time() < 0.3) simulation.step();

  const double turn = 3.0 * simulation.time();
  const geometry::Quat turned(Eigen::AngleAxisd(turn, Vec3::UnitZ()));
  for (std::size_t t = 0; t < simulation.ties().size(); ++t) {
    const dynamics::Tie& tie = simulation.ties().tie(t);
    const std::size_t point = index_of(point_of(tie));
    const Vec3 place = start[body] + Vec3(0.2 * simulation.time(), 0.0, 0.0) +
                       turned * Vec3(start[point] - start[body]);
    EXPECT_LT((simulation.state().position[point] - place).norm(), 1e-11);
    const double stretch = (simulation.state().position[index_of(tie.node)] - place).norm();
    EXPECT_LT(stretch, 2e-3);  // m, of the 60 mm that it went
    EXPECT_NEAR(simulation.ties().pull(t), 2e3 * stretch, 2e3 * 2e-4);  // of the step before
  }
}

TEST(BuildTies, HoldTheCentreOfAnotherBody) {
  const BuiltScene scene = built({"ties.glue.from={ rigid_body = \"clump\" }"});

  ASSERT_EQ(scene.scene.ties.size(), 1U);
  EXPECT_EQ(scene.scene.ties[0].node, rigid_body_of(0, scene).node);
  EXPECT_EQ(scene.scene.state.position[index_of(point_of(scene.scene.ties[0]))],
            scene.scene.state.position[index_of(scene.scene.ties[0].node)]);
}

/// A grid that is partly closed: a facet, and a bar that goes on from it.
TEST(BuildTies, FindBarsBesideFacets) {
  const BuiltScene scene = build_scene(parse_scenario(R"([simulation]
duration = "1 ms"
[materials.m]
young_modulus = "1 GPa"
friction_angle = "20 deg"
[[membranes]]
name = "grid"
shape = { kind = "facets", points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [3, 0, 0]], facets = [[0, 1, 2]], bars = [[1, 3]] }
mode = "lattice"
thickness = "20 mm"
material = "m"
density = 1000
young_modulus = "1 GPa"
hold = "all"
[[membranes]]
name = "pole"
shape = { kind = "chain", points = [[2.5, 0, 1], [2.5, 0, 0.1]] }
mode = "lattice"
thickness = "20 mm"
material = "m"
density = 1000
young_modulus = "1 GPa"
[[ties]]
name = "tie"
from = { membrane = "pole", nodes = "z_min" }
to = { kind = "surface", membrane = "grid" }
)",
                                                      "case.toml", {}));

  ASSERT_EQ(scene.ties.size(), 1U);
  EXPECT_EQ(scene.ties[0].count, 1U);
  EXPECT_NEAR(scene.ties[0].longest_gap, 0.1, 1e-12);
}

TEST(BuildTies, ToABodySayWhatIsWrong) {
  EXPECT_THAT(error_of({"ties.glue.to.rigid_body=blok"}),
              HasSubstr("ties.glue.to.rigid_body: there is none called \"blok\"; did you mean "
                        "\"block\"?"));
  EXPECT_THAT(error_of({"ties.glue.to={ kind = \"body\" }"}),
              HasSubstr("ties.glue.to.rigid_body: missing"));
  EXPECT_THAT(error_of({"ties.glue.from={ rigid_body = \"block\" }"}),
              HasSubstr("ties.glue.to.rigid_body: ties \"block\" to itself; expected another body "
                        "than that of from"));
  EXPECT_THAT(error_of({"ties.glue.from={ rigid_body = \"clump\" }", "ties.glue.stiffness=0"}),
              HasSubstr("ties.glue.stiffness"));
}

}  // namespace
}  // namespace plekton::apps::build_ties_test
