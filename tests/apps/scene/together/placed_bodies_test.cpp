// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies whose place and motion at the start are told one by one: chains, single grains, membranes
// that fly.
#include "apps/scenario/scenario_reader.hpp"
#include "apps/scene/build_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace plekton::apps::placed_bodies_test {
namespace {

using dynamics::Held;
using geometry::NodeId;
using testing::HasSubstr;
using testing::Not;

constexpr std::string_view kScenario = R"([simulation]
duration = "1 s"
[materials.rock]
density = "2650 kg/m3"
young_modulus = "20 MPa"
friction_angle = "35 deg"
[[membranes]]
name = "rope"
shape = { kind = "chain", points = [[0, 0, 1], [1, 0, 1], [1, 2, 1]], divisions = 2 }
thickness = "2 cm"
material = "rock"
young_modulus = "1 GPa"
density = "1000 kg/m3"
hold = "rim"
initial_velocity = [0, 0, "3 m/s"]
[[grains]]
name = "pair"
material = "rock"
radius = "5 cm"
centres = [[0, 0, "2 m"], [0.1, 0, 2]]
velocity = [0, 0, -1]
angular_velocity = [0, "7 rad/s", 0]
)";

BuiltScene built(const std::vector<std::string>& overrides = {}) {
  return build_scene(parse_scenario(kScenario, "case.toml", overrides));
}

std::string error_of(const std::vector<std::string>& overrides) {
  try {
    built(overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(PlacedBodies, LinkAChainThroughItsPoints) {
  const BuiltScene scene = built();

  const BuiltMembrane& rope = scene.membranes.at(0);
  EXPECT_EQ(rope.nodes, 5u);
  EXPECT_EQ(rope.beams, 4u);
  EXPECT_EQ(rope.facets, 0u);
  // 1000 kg/m3 pi (1 cm)² 3 m
  EXPECT_NEAR(rope.mass, 0.3 * std::numbers::pi, 1e-12);
  EXPECT_EQ(scene.scene.state.position[1], Vec3(0.5, 0.0, 1.0));
  EXPECT_EQ(scene.scene.state.position[4], Vec3(1.0, 2.0, 1.0));
  EXPECT_EQ(scene.scene.bonds[3].nodes, (std::array{NodeId{3}, NodeId{4}}));
}

TEST(PlacedBodies, HoldTheEndsOfAChainAsItsRim) {
  const dynamics::Scene scene = built().scene;

  EXPECT_EQ(scene.properties.held[0], Held::translation);
  EXPECT_EQ(scene.properties.held[2], Held::nothing);
  EXPECT_EQ(scene.properties.held[4], Held::translation);
}

TEST(PlacedBodies, CloseAChainThatEndsWhereItBegins) {
  const BuiltScene scene =
      built({"membranes.rope.shape.points=[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 0]]",
             "membranes.rope.shape.divisions=1", "membranes.rope.hold=none"});

  EXPECT_EQ(scene.membranes.at(0).nodes, 3u);
  EXPECT_EQ(scene.membranes.at(0).beams, 3u);
}

TEST(PlacedBodies, LetWhatIsNotHeldFlyAtTheStart) {
  const dynamics::NodeState state = built().scene.state;

  EXPECT_EQ(state.velocity[0], Vec3::Zero());
  EXPECT_EQ(state.velocity[1], Vec3(0.0, 0.0, 3.0));
}

TEST(PlacedBodies, PutGrainsWhereTheyAreToldInThatOrder) {
  const BuiltScene scene = built();

  EXPECT_EQ(scene.grains.at(0).count, 2u);
  EXPECT_EQ(scene.scene.state.position[5], Vec3(0.0, 0.0, 2.0));
  EXPECT_EQ(scene.scene.state.position[6], Vec3(0.1, 0.0, 2.0));
  EXPECT_EQ(scene.scene.state.velocity[6], Vec3(0.0, 0.0, -1.0));
  EXPECT_EQ(scene.scene.state.angular_velocity[6], Vec3(0.0, 7.0, 0.0));
  EXPECT_EQ(scene.scene.elements.spheres[1].radius, 0.05);
}

TEST(PlacedBodies, RefuseWhatDoesNotGoWithAChain) {
  EXPECT_THAT(error_of({"membranes.rope.shape.points=[[0, 0, 0]]"}),
              HasSubstr("points: got a list of 1; expected a list of at least 2 vectors"));
  EXPECT_THAT(error_of({"membranes.rope.shape.points=[[0, 0, 0], [0, 0, 0]]"}),
              HasSubstr("points 0 and 1 of a chain are equal"));
  EXPECT_THAT(error_of({"membranes.rope.shape.points=[[0, 0, 0], [1, 0, 0], [0, 0, 0]]",
                        "membranes.rope.shape.divisions=1"}),
              HasSubstr("a closed chain has 2 links; expected at least 3"));
  EXPECT_THAT(error_of({"membranes.rope.areal_mass=1"}), HasSubstr("a chain has no area"));
  EXPECT_THAT(error_of({"membranes.rope.mode=continuum"}), HasSubstr("a net has no facets"));
}

TEST(PlacedBodies, RefuseWhatDoesNotGoWithCentres) {
  EXPECT_THAT(error_of({"grains.pair.count=3"}), HasSubstr("count: centres says where each"));
  EXPECT_THAT(error_of({"grains.pair.placement=lattice"}),
              HasSubstr("placement: centres says where each"));
  EXPECT_THAT(error_of({"grains.pair.centres=[[0, 0, 1], [0, 0, 1]]"}),
              HasSubstr("centres: two grains are at (0, 0, 1) m"));
  EXPECT_THAT(error_of({"grains.pair.centres=[0, 0, 1]"}),
              HasSubstr("centres[0]: got 0; expected a list of three components"));
}

TEST(PlacedBodies, HaveFacetsBetweenTheirPoints) {
  const BuiltScene scene = built(
      {"membranes.rope.shape={kind = \"facets\", points = [[0, 0, 1], [1, 0, 1], [1, 2, 1], [0, 2, "
       "1]], facets = [[0, 1, 2], [2, 3, 0]]}"});

  EXPECT_EQ(scene.membranes.at(0).facets, 2u);
  EXPECT_EQ(scene.membranes.at(0).beams, 5u);
  EXPECT_EQ(scene.membranes.at(0).held_nodes, 4u);
  EXPECT_DOUBLE_EQ(scene.membranes.at(0).area, 2.0);
  EXPECT_EQ(scene.scene.elements.facets.at(1).nodes, (std::array{NodeId{2}, NodeId{3}, NodeId{0}}));
}

TEST(PlacedBodies, HaveBarsBetweenTheirPointsAndAreHeldAtTheirEnds) {
  const BuiltScene scene = built(
      {"membranes.rope.shape={kind = \"bars\", points = [[0, 0, 1], [0, 0, 2], [1, 0, 1], [0, 1, "
       "1]], bars = [[3, 0], [1, 0], [0, 2]]}"});

  // A tripod: the node in the middle is free.
  EXPECT_EQ(scene.membranes.at(0).facets, 0u);
  EXPECT_EQ(scene.membranes.at(0).held_nodes, 3u);
  EXPECT_EQ(scene.scene.properties.held.at(0), Held::nothing);
  ASSERT_EQ(scene.scene.elements.cylinders.size(), 3u);
  EXPECT_EQ(scene.scene.elements.cylinders[0].nodes, (std::array{NodeId{0}, NodeId{1}}));
  EXPECT_EQ(scene.scene.elements.cylinders[2].nodes, (std::array{NodeId{0}, NodeId{3}}));
}

TEST(PlacedBodies, RefusePointsThatDoNotExistAndBarsThatAreThereTwice) {
  const std::string points = "points = [[0, 0, 1], [1, 0, 1], [1, 2, 1]]";

  EXPECT_THAT(error_of({"membranes.rope.shape={kind = \"facets\", " + points +
                        ", facets = [[0, 1, 3], [0, 1, 1], [0, 1]]}"}),
              testing::AllOf(HasSubstr("shape.facets[0]: got [0, 1, 3]; expected 3 different whole "
                                       "numbers from 0 to 2"),
                             HasSubstr("shape.facets[1]: got [0, 1, 1]"),
                             HasSubstr("shape.facets[2]: got [0, 1]")));
  EXPECT_THAT(
      error_of({"membranes.rope.shape={kind = \"bars\", " + points + ", bars = [[0, 1], [1, 0]]}"}),
      HasSubstr("shape.bars: two are between the points 0 and 1; leave one out"));
}

TEST(PlacedBodies, HaveRadiiOfTheirOwn) {
  const std::string no_radius = "grains.pair.radii=[\"4 cm\", 0.03]";
  std::string text(kScenario);
  text.erase(text.find("radius = "), std::string("radius = \"5 cm\"\n").size());
  const std::vector<std::string> overrides = {no_radius};

  const BuiltScene scene = build_scene(parse_scenario(text, "case.toml", overrides));

  EXPECT_EQ(scene.scene.elements.spheres.at(0).radius, 0.04);
  EXPECT_EQ(scene.scene.elements.spheres.at(1).radius, 0.03);
  EXPECT_EQ(scene.grains.at(0).smallest, 0.03);
  EXPECT_THAT(error_of(overrides),
              HasSubstr("grains.pair.radius: radii says how large each grain is"));
}

TEST(PlacedBodies, ComplainOfWrongCentresAlone) {
  const std::string error =
      error_of({"grains.pair.centres=[[0, 0, 1], [0, 1]]", "grains.pair.radii=[\"4 cm\", 0.03]"});

  EXPECT_THAT(error, HasSubstr("grains.pair.centres[1]: got a list of 2"));
  EXPECT_THAT(error, Not(HasSubstr("grains.pair.radii")));
  EXPECT_THAT(error_of({"grains.pair.radii=[\"4 cm\"]"}),
              HasSubstr("grains.pair.radii: got a list of 1; expected a list of 2"));
}

TEST(PlacedBodies, HaveBarsBesideFacetsOnTheSameNodes) {
  const std::string shape =
      "membranes.rope.shape={kind = \"facets\", points = [[0, 0, 1], [1, 0, 1], [0, 1, 1], [2, 0, "
      "1]], facets = [[0, 1, 2]], bars = [[3, 1]]}";

  const BuiltScene scene = built({shape});

  EXPECT_EQ(scene.membranes.at(0).facets, 1u);
  EXPECT_EQ(scene.membranes.at(0).beams, 4u);
  ASSERT_EQ(scene.scene.elements.cylinders.size(), 4u);
  EXPECT_EQ(scene.scene.elements.cylinders[3].nodes, (std::array{NodeId{1}, NodeId{3}}));
  // 1000 kg/m3 pi (1 cm)², of four sides: 1, 1, sqrt(2) and 1 m
  EXPECT_NEAR(scene.membranes.at(0).mass, 0.1 * std::numbers::pi * (3.0 + std::numbers::sqrt2),
              1e-12);
  EXPECT_THAT(error_of({shape, "membranes.rope.shape.bars=[[1, 0]]"}),
              HasSubstr("shape.bars: the one between the points 0 and 1 is a side of a facet"));
  EXPECT_THAT(error_of({shape, "membranes.rope.mode=continuum"}),
              HasSubstr("mode: the bars beside the facets are beams"));
  EXPECT_THAT(error_of({shape, "membranes.rope.mass_mode=area"}),
              HasSubstr("mass_mode: the bars beside the facets would have no mass"));
}

std::string without(std::string text, const std::string& line) {
  return text.erase(text.find(line), line.size());
}

TEST(PlacedBodies, MoveEachAsItIsTold) {
  const std::string text =
      without(without(without(std::string(kScenario), "velocity = [0, 0, -1]\n"),
                      "angular_velocity = [0, \"7 rad/s\", 0]\n"),
              "initial_velocity = [0, 0, \"3 m/s\"]\n");
  const std::vector<std::string> overrides = {
      "grains.pair.velocities=[[1, 0, 0], [0, \"2 m/s\", 0]]",
      "grains.pair.angular_velocities=[[0, 0, 3], [4, 0, 0]]",
      "membranes.rope.shape={kind = \"bars\", points = [[0, 0, 1], [1, 0, 1], [2, 0, 1]], bars = "
      "[[0, 1], [1, 2]]}",
      "membranes.rope.initial_velocities=[[9, 0, 0], [0, 5, 0], [9, 0, 0]]"};

  const dynamics::NodeState state =
      build_scene(parse_scenario(text, "case.toml", overrides)).scene.state;

  EXPECT_EQ(state.velocity[0], Vec3::Zero());  // held
  EXPECT_EQ(state.velocity[1], Vec3(0.0, 5.0, 0.0));
  EXPECT_EQ(state.velocity[3], Vec3(1.0, 0.0, 0.0));
  EXPECT_EQ(state.velocity[4], Vec3(0.0, 2.0, 0.0));
  EXPECT_EQ(state.angular_velocity[3], Vec3(0.0, 0.0, 3.0));
  EXPECT_EQ(state.angular_velocity[4], Vec3(4.0, 0.0, 0.0));
}

TEST(PlacedBodies, RefuseVelocitiesThatAreNotOneForEach) {
  EXPECT_THAT(
      error_of({"grains.pair.velocities=[[1, 0, 0]]"}),
      testing::AllOf(HasSubstr("velocities: got a list of 1; expected one for each of the 2"),
                     HasSubstr("velocity: velocities says that of each grain")));
  EXPECT_THAT(
      error_of({"membranes.rope.initial_velocities=[[1, 0, 0]]"}),
      testing::AllOf(HasSubstr("initial_velocities: goes with a shape of kind facets or bars"),
                     HasSubstr("initial_velocity: initial_velocities says how each node")));
  EXPECT_THAT(error_of({"membranes.rope.shape={kind = \"bars\", points = [[0, 0, 1], [1, 0, 1]], "
                        "bars = [[0, 1]]}",
                        "membranes.rope.initial_velocities=[[1, 0, 0]]"}),
              HasSubstr("initial_velocities: got a list of 1; expected one for each of the 2"));
}

}  // namespace
}  // namespace plekton::apps::placed_bodies_test
