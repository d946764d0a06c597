// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/takeover/scenario_text.hpp"

#include "apps/scenario/scenario_reader.hpp"
#include "apps/scene/build_scene.hpp"
#include "tests/apps/takeover/grid_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace plekton::apps::yade::scenario_text_test {
namespace {

using testing::Contains;
using testing::HasSubstr;

BuiltScene built(const Scene& scene, Takeover* told = nullptr) {
  const Takeover takeover = take_over(scene, {.script = "case.py"});
  if (told != nullptr) *told = takeover;
  return build_scene(parse_scenario(takeover.scenario, "case.toml"));
}

Sphere sphere_at(const Vec3& centre, double radius) {
  Sphere sphere;
  sphere.id = 300;
  sphere.material = 0;
  sphere.position = centre;
  sphere.radius = radius;
  sphere.mass = 1000.0 * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  return sphere;
}

TEST(ScenarioText, HasTheNodesFacetsAndMassesOfGrids) {
  const Scene scene = grid_scene();

  const BuiltScene result = built(scene);

  ASSERT_EQ(result.membranes.size(), 2u);
  EXPECT_EQ(result.membranes[0].nodes, 5u);
  EXPECT_EQ(result.membranes[0].facets, 1u);
  EXPECT_EQ(result.membranes[0].beams, 6u);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    EXPECT_EQ(result.scene.state.position[i], scene.nodes[i].position);
  }
  double mass = 0.0;
  for (std::size_t i = 0; i < 5; ++i) mass += scene.nodes[i].mass;
  EXPECT_NEAR(result.membranes[0].mass, mass, 1e-12 * mass);
}

TEST(ScenarioText, HoldsAndMovesWhatIsBlocked) {
  Scene scene = grid_scene();
  for (const std::size_t i : {0u, 1u}) scene.nodes[i].blocked = "xyzXYZ";
  scene.nodes[4].blocked = "xz";
  scene.nodes[4].velocity = {0.25, 0.0, 0.0};
  scene.nodes[3].blocked = "X";
  scene.nodes[4].angular_velocity = {0.0, 7.0, 0.0};  // about an axis that is free

  Takeover told;
  const BuiltScene result = built(scene, &told);

  ASSERT_EQ(result.scene.loads.motions.size(), 2u);
  EXPECT_THAT(told.scenario, HasSubstr("components = \"xyz\"\ndisplacement = [0, 0, 0]\n"
                                       "hold_rotation = true\n"));
  EXPECT_THAT(told.scenario, HasSubstr("components = \"xz\"\nvelocity = [0.25, 0, 0]"));
  EXPECT_THAT(told.notes,
              Contains(HasSubstr("rotation of 1 nodes is blocked about X alone: left out")));
}

TEST(ScenarioText, HasSpheresWithTheirMotionAndForces) {
  Scene scene = grid_scene();
  scene.spheres = {sphere_at({0.3, 0.3, 1.0}, 0.1), sphere_at({0.3, 0.3, 2.0}, 0.2)};
  scene.spheres[1].id = 301;
  scene.spheres[1].velocity = {0.0, 0.0, -3.0};
  scene.forces = {{301, {5.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}};

  const BuiltScene result = built(scene);

  ASSERT_EQ(result.grains.size(), 1u);
  EXPECT_NEAR(result.grains[0].mass, scene.spheres[0].mass + scene.spheres[1].mass, 1e-9);
  EXPECT_EQ(result.scene.state.velocity[7], Vec3::Zero());
  EXPECT_EQ(result.scene.state.velocity[8], Vec3(0.0, 0.0, -3.0));
  ASSERT_EQ(result.scene.loads.forces.size(), 1u);
}

TEST(ScenarioText, LoadsSpheresWithEqualForcesTogether) {
  Scene scene;
  scene.time_step = 1e-6;
  scene.materials = {{.type = "FrictMat", .label = "steel", .young = 1e9, .poisson = 0.3}};
  for (int i = 0; i < 4; ++i) {
    scene.spheres.push_back(sphere_at({1.0 * i, 0.0, 0.0}, 0.1));
    scene.spheres.back().id = i;
  }
  scene.forces = {{2, {0.0, 0.0, 3.0}, Vec3::Zero()},
                  {0, {5.0, 0.0, 0.0}, Vec3::Zero()},
                  {3, {0.0, 0.0, 3.0}, Vec3::Zero()}};

  const BuiltScene result = built(scene);

  ASSERT_EQ(result.scene.loads.forces.size(), 2u);
  EXPECT_EQ(result.scene.loads.forces[0].nodes.size(), 2u);
  EXPECT_EQ(result.scene.loads.forces[1].nodes.size(), 1u);
}

TEST(ScenarioText, NamesItsScriptInOneLine) {
  TakeoverOptions options;
  for (const char* script : {"a\nb.py", "a\n  b.py", "a\x1b\tb.py"}) {
    options.script = script;

    const Takeover takeover = take_over(grid_scene(), options);

    EXPECT_NO_THROW(parse_scenario(takeover.scenario, "case.toml")) << script;
  }
  options.script = "a\nb.py";
  EXPECT_THAT(take_over(grid_scene(), options).scenario, HasSubstr("Taken over from a\\nb.py at"));
}

TEST(ScenarioText, TurnsAWallToTheBodiesAndLeavesOneBetweenThemOut) {
  Scene scene = grid_scene();
  Wall wall;
  wall.id = 400;
  wall.material = 0;
  wall.axis = 2;
  wall.position = {0.0, 0.0, 1.0};
  scene.walls = {wall};

  EXPECT_EQ(built(scene).scene.planes.at(0).normal, Vec3(0.0, 0.0, -1.0));

  scene.spheres = {sphere_at({0.3, 0.3, 2.0}, 0.1)};
  Takeover told;
  EXPECT_TRUE(built(scene, &told).scene.planes.empty());
  EXPECT_THAT(told.notes, Contains(HasSubstr("wall 400: there are bodies on both of its sides")));
}

TEST(ScenarioText, KeepsTheOuterSizeOfABox) {
  Scene scene;
  scene.time_step = 1e-6;
  scene.materials = {{.type = "FrictMat", .label = "steel", .young = 1e9, .poisson = 0.3}};
  scene.spheres = {sphere_at({0.0, 0.0, 5.0}, 0.5)};
  RigidFacets box;
  box.material = 0;
  box.is_box = true;
  box.blocked = "xyzXYZ";
  for (int i = 0; i < 8; ++i)
    box.points.emplace_back((i & 1) * 2 - 1, (i >> 1 & 1) * 2 - 1, (i >> 2) * 2 - 1);
  box.facets = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  scene.facets = {box};

  const BuiltScene result = built(scene);

  ASSERT_EQ(result.scene.elements.facets.size(), 12u);
  const double half = result.scene.elements.facets[0].radius;
  double top = 0.0;
  for (const auto& x : result.scene.state.position)
    if (x[2] < 4.0) top = std::max(top, x[2]);
  EXPECT_NEAR(top + half, 1.0, 1e-15);
}

TEST(ScenarioText, HasClumpsAsRigidBodies) {
  Scene scene = grid_scene();
  Clump clump;
  clump.id = 500;
  clump.material = 0;
  clump.position = {0.0, 0.0, 3.0};
  clump.mass = 2.0;
  clump.inertia = {0.1, 0.2, 0.25};
  clump.axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  clump.centres = {{-0.1, 0.0, 3.0}, {0.1, 0.0, 3.0}};
  clump.radii = {0.15, 0.15};
  clump.velocity = {0.0, 1.0, 0.0};
  scene.clumps = {clump};

  const BuiltScene result = built(scene);

  ASSERT_EQ(result.rigid_bodies.size(), 1u);
  EXPECT_NEAR(result.rigid_bodies[0].mass.mass, 2.0, 1e-15);
  EXPECT_EQ(result.rigid_bodies[0].moments.maxCoeff(), 0.25);
}

TEST(ScenarioText, SaysOnceWhatIsSoOfManyBodies) {
  const std::vector<std::string> notes = take_over(grid_scene(), {}).notes;

  EXPECT_THAT(notes, Contains(HasSubstr("membrane \"grid 0\" and 1 more: across its beams")));
}

TEST(ScenarioText, JoinsFacetsAndBoxesThatMoveAlike) {
  Scene scene = grid_scene();
  RigidFacets facets;
  facets.material = 0;
  facets.blocked = "xyzXYZ";
  facets.points = {{0, 0, -5}, {1, 0, -5}, {0, 1, -5}};
  facets.facets = {{0, 1, 2}};
  scene.facets.assign(3, facets);
  scene.facets[1].points = {{1, 0, -5}, {1, 1, -5}, {0, 1, -5}};
  scene.facets[2].points[2] = {0, 9, -5};
  scene.facets[2].velocity = {0, 0, 1};

  const BuiltScene result = built(scene);

  ASSERT_EQ(result.rigid_bodies.size(), 2u);
  EXPECT_EQ(result.scene.elements.facets.size(), 1u + 3u);
  EXPECT_EQ(result.scene.state.velocity.back(), Vec3(0.0, 0.0, 1.0));
}

// A strip of squares of two facets each, told one by one.
TEST(ScenarioText, JoinsTheCornersOfFacetsThatAreToldOneByOne) {
  Scene scene = grid_scene();
  RigidFacets facet;
  facet.material = 0;
  facet.blocked = "xyzXYZ";
  facet.facets = {{0, 1, 2}};
  constexpr int kSquares = 50;
  for (int i = 0; i < kSquares; ++i) {
    const double x = i;
    facet.points = {{x, 0, -5}, {x + 1, 0, -5}, {x, 1, -5}};
    scene.facets.push_back(facet);
    facet.points = {{x + 1, 0, -5}, {x + 1, 1, -5}, {x, 1, -5}};
    scene.facets.push_back(facet);
  }

  const std::string scenario = take_over(scene, {.script = "case.py"}).scenario;

  const auto points = [&] {
    const std::size_t begin = scenario.rfind("shape.points = [\n");
    const std::size_t end = scenario.find("]\nshape.facets", begin);
    return std::count(scenario.begin() + static_cast<std::ptrdiff_t>(begin),
                      scenario.begin() + static_cast<std::ptrdiff_t>(end), '\n');
  };
  // A line for each, and that of the bracket.
  EXPECT_EQ(points(), 2 * (kSquares + 1) + 1);
}

TEST(ScenarioText, SaysWhatIsLeftOut) {
  Scene scene = grid_scene();
  scene.is_periodic = true;
  scene.others = {{"Polyhedra", 4}};
  scene.engines = {"NewtonIntegrator", "PyRunner"};
  scene.functors.push_back("Law2_ScGeom_ViscElPhys_Basic");
  scene.functor_settings["Ip2_FrictMat_FrictMat_MindlinPhys"] = {"en", "frictAngle"};
  scene.contacts = 3;

  const std::vector<std::string> notes = take_over(scene, {}).notes;

  for (const char* what : {"the cell is periodic", "4 bodies of shape Polyhedra", "engine PyRunner",
                           "Law2_ScGeom_ViscElPhys_Basic: has no counterpart",
                           "Ip2_FrictMat_FrictMat_MindlinPhys: what it sets is left out: en, "
                           "frictAngle; contacts are as",
                           "3 contacts are there", "grids do not touch each other in YADE"})
    EXPECT_THAT(notes, Contains(HasSubstr(what)));
}

}  // namespace
}  // namespace plekton::apps::yade::scenario_text_test
