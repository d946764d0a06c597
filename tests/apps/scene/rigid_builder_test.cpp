// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid bodies of a scenario: what is read and what is built of it.
#include "apps/scene/rigid_builder.hpp"

#include "apps/scenario/scenario_reader.hpp"
#include "dynamics/scene_check.hpp"
#include "dynamics/simulation.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/temporary_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace plekton::apps::rigid_builder_test {
namespace {

using dynamics::Held;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::string_view kScenario = R"([simulation]
duration = "1 s"
[materials.steel]
density = "7850 kg/m3"
young_modulus = "20 MPa"
friction_angle = "10 deg"
[[rigid_bodies]]
name = "clump"
spheres = [{ centre = [0, 0, 0], radius = "1 cm" }, { centre = [0.012, 0, 0], radius = "1 cm" }]
translate = [0, 0, "5 cm"]
material = "steel"
density = "2000 kg/m3"
velocity = [0, 0, "-1 m/s"]
[[rigid_bodies]]
name = "tray"
shape = { kind = "box", size = [0.2, 0.2, 0.05], open = ["z_max"] }
translate = [-0.1, -0.1, -0.1]
thickness = "2 mm"
material = "steel"
hold = "xyz"
hold_rotation = "xyz"
[[rigid_bodies]]
name = "lid"
shape = { kind = "box", size = [0.1, 0.1, 0.02] }
translate = [-0.05, -0.05, 0.1]
thickness = "2 mm"
material = "steel"
density = "1000 kg/m3"
hold = "xy"
hold_rotation = "z"
[[grains]]
name = "sand"
material = "steel"
radius = "4 mm"
count = 20
box = { min = [-0.09, -0.09, -0.09], max = [0.09, 0.09, -0.06] }
[[loads]]
name = "press"
kind = "force"
rigid_body = "lid"
force = [0, 0, "-5 N"]
[[output.reactions]]
name = "on the tray"
kind = "contacts"
rigid_body = "tray"
)";

BuiltScene built(const std::vector<std::string>& overrides = {}) {
  return build_scene(parse_scenario(kScenario, "case.toml", overrides));
}

std::string error_of(const std::vector<std::string>& overrides) {
  try {
    const BuiltScene scene = built(overrides);
    dynamics::check(scene.scene);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

const BuiltRigidBody& body_called(const std::string& name, const BuiltScene& scene) {
  return *std::find_if(scene.rigid_bodies.begin(), scene.rigid_bodies.end(),
                       [&](const BuiltRigidBody& body) { return body.name == name; });
}

TEST(RigidBuilder, MakesBodiesThatASimulationTakes) {
  BuiltScene scene = built();

  EXPECT_EQ(scene.rigid_bodies.size(), 3U);
  EXPECT_EQ(scene.scene.elements.spheres.size(), 22U);
  dynamics::Simulation simulation(scene.scene, {});
  for (int i = 0; i < 10; ++i) simulation.step();
  EXPECT_EQ(simulation.state().position[index_of(body_called("tray", scene).node)],
            scene.scene.state.position[index_of(body_called("tray", scene).node)]);
}

TEST(RigidBuilder, FindsMassAndCentreOfASolid) {
  const BuiltScene scene = built();

  const BuiltRigidBody& lid = body_called("lid", scene);

  EXPECT_NEAR(lid.mass.mass, 0.2, 1e-14);
  EXPECT_LT((lid.mass.centre - Vec3(0, 0, 0.11)).norm(), 1e-15);
  EXPECT_NEAR(lid.moments[2], 0.2 / 12.0 * 0.02, 1e-15);
  EXPECT_EQ(lid.held & Held::everything, Held::along_x | Held::along_y | Held::about_z);
}

// Two spheres of radius r at a distance d have pi / 12 (4 r + d) (2 r - d)² in common.
TEST(RigidBuilder, CountsWhatSpheresHaveInCommonOnce) {
  const BuiltScene scene = built();

  const double r = 0.01, d = 0.012;
  const double lens = std::numbers::pi / 12.0 * (4.0 * r + d) * (2.0 * r - d) * (2.0 * r - d);
  const double volume = 8.0 / 3.0 * std::numbers::pi * r * r * r - lens;
  EXPECT_NEAR(body_called("clump", scene).mass.mass, 2000.0 * volume, 1e-12 * 2000.0 * volume);
  const auto node = index_of(body_called("clump", scene).node);
  EXPECT_EQ(scene.scene.state.velocity[node], Vec3(0, 0, -1));
}

TEST(RigidBuilder, LeavesOutTheSidesThatAreOpen) {
  const BuiltScene scene = built();

  EXPECT_EQ(scene.membranes[0].facets, 10U);
  EXPECT_EQ(scene.membranes[0].nodes, 8U);
}

// Two hexagons with the corners of one over the middles of the sides of the other: h / 6 (A + 4 M +
// A), M with twelve corners at r cos 15 deg.
TEST(RigidBuilder, MakesASolidOfATubeWithBothEnds) {
  const std::string tube =
      "rigid_bodies.lid.shape={ kind = \"tube\", radius = 0.1, length = 0.02, cells = [6, 1], ";
  const BuiltScene scene = built({tube + "closed = [\"z_max\", \"z_min\"] }"});

  const double end = 1.5 * std::sqrt(3.0) * 0.01;
  const double middle = 3.0 * std::pow(0.1 * std::cos(std::numbers::pi / 12.0), 2);
  const double volume = 0.02 * (2.0 * end + 4.0 * middle) / 6.0;
  EXPECT_NEAR(body_called("lid", scene).mass.mass, 1000.0 * volume, 1e-13);
  EXPECT_LT((body_called("lid", scene).mass.centre - Vec3(-0.05, -0.05, 0.11)).norm(), 1e-15);
  EXPECT_THAT(error_of({tube + "closed = [\"z_max\"] }", "rigid_bodies.lid.filling=solid"}),
              HasSubstr("rigid_bodies.lid: its mesh is open and encloses no volume"));
  EXPECT_THAT(error_of({tube + "closed = [\"x_min\"] }"}),
              HasSubstr("rigid_bodies.lid.shape.closed: there is no side \"x_min\"; the sides are "
                        "\"z_min\", \"z_max\""));
  EXPECT_THAT(error_of({"rigid_bodies.lid.shape={ kind = \"tube\", radius = 0.1, length = 1, "
                        "cells = [6000, 1], closed = [\"z_max\"] }"}),
              HasSubstr("rigid_bodies.lid.shape.cells: asks for about 6e+06 facets or bars"));
}

TEST(RigidBuilder, LoadsABodyAsAWhole) {
  const BuiltScene scene = built();

  ASSERT_EQ(scene.scene.loads.forces.size(), 1U);
  EXPECT_EQ(scene.scene.loads.forces[0].nodes, std::vector{body_called("lid", scene).node});
  EXPECT_EQ(scene.reactions[0].nodes.size(), 8U);
}

TEST(RigidBuilder, RefusesABodyWithoutVolumeOrMass) {
  EXPECT_THAT(error_of({"rigid_bodies.tray.hold=none"}),
              HasSubstr("rigid_bodies.tray.density: got none of density and mass"));
  EXPECT_THAT(error_of({"rigid_bodies.lid.mass=1"}),
              HasSubstr("rigid_bodies.lid.density: got density and mass too"));
  EXPECT_THAT(error_of({"rigid_bodies.tray.density=1000", "rigid_bodies.tray.filling=solid"}),
              HasSubstr("rigid_bodies.tray: its mesh is open and encloses no volume"));
  EXPECT_THAT(error_of({"rigid_bodies.tray.density=1000", "rigid_bodies.tray.hold=none"}),
              IsEmpty());
}

// I_x + I_y - I_z is twice the integral of z² over the mass; 0 of a flat body.
TEST(RigidBuilder, RefusesAnInertiaThatNoBodyHas) {
  const auto with = [](const std::string& inertia) {
    return error_of({"rigid_bodies.tray.mass=1", "rigid_bodies.tray.inertia=" + inertia});
  };

  EXPECT_THAT(with("[1, 2.5, 1]"),
              HasSubstr("rigid_bodies.tray.inertia: got [1, 2.5, 1] kg m2; expected none above the "
                        "sum of the other two, as of every body, and 2.5 is above 2"));
  EXPECT_THAT(with("[0.1, 0.2, 0.3]"), IsEmpty());
  EXPECT_THAT(with("[0.4, 0.4, 0.4]"), IsEmpty());
}

TEST(RigidBuilder, TellsWhatIsDoubtfulAboutAMesh) {
  const test::TemporaryFolder folder;
  geometry::Mesh nested = geometry::box_shell({0.1, 0.1, 0.1}, {1, 1, 1});
  const geometry::Mesh inner = geometry::box_shell({0.05, 0.05, 0.05}, {1, 1, 1});
  const std::size_t outer = nested.points.size();
  for (const Vec3& point : inner.points) nested.points.push_back(point + Vec3::Constant(0.025));
  for (std::array<geometry::NodeId, 3> facet : inner.facets) {
    for (geometry::NodeId& node : facet)
      node = geometry::id_at<geometry::NodeId>(index_of(node) + outer);
    nested.facets.push_back(facet);
  }
  std::string text = fmt::format("OFF\n{} {} 0\n", nested.points.size(), nested.facets.size());
  for (const Vec3& x : nested.points) text += fmt::format("{} {} {}\n", x[0], x[1], x[2]);
  for (const auto& facet : nested.facets)
    text += fmt::format("3 {} {} {}\n", index_of(facet[0]), index_of(facet[1]), index_of(facet[2]));
  test::write_bytes(folder / "nested.off", text);
  const std::string body =
      "\n[[rigid_bodies]]\nname = \"nested\"\nmesh = \"nested.off\"\n"
      "thickness = \"1 mm\"\nmaterial = \"steel\"\ndensity = 1000\n"
      "translate = [1, 0, 0]\n";

  const BuiltScene scene =
      build_scene(parse_scenario(std::string(kScenario) + body, folder / "case.toml", {}));

  EXPECT_THAT(scene.warnings,
              testing::Contains(HasSubstr("nested: the mesh is closed but bounds no volume")));
}

TEST(RigidBuilder, RefusesALoadOnAnInnerNode) {
  EXPECT_THAT(error_of({"loads.press.nodes=z_max"}),
              HasSubstr("loads.press.nodes: a rigid body moves as one, and its inner nodes bear no "
                        "loads of their own"));
}

// Two bars of pi r² 0.3 m and 0.4 m at a right angle: the centre from their middles.
TEST(RigidBuilder, MakesBarsOfANet) {
  const std::string bars =
      "rigid_bodies.lid.shape={ kind = \"chain\", points = [[0, 0, 0], [0.3, 0, 0], [0.3, 0.4, 0]] "
      "}";
  const BuiltScene scene = built({bars, "rigid_bodies.lid.thickness=\"20 mm\""});

  EXPECT_EQ(scene.scene.elements.cylinders.size(), 2U);
  EXPECT_TRUE(scene.scene.bonds.empty());
  const dynamics::MassProperties& mass = body_called("lid", scene).mass;
  const double expected = 1000.0 * std::numbers::pi * 0.01 * 0.01 * 0.7;
  EXPECT_NEAR(mass.mass, expected, 1e-13 * expected);
  const Vec3 middle = (0.3 * Vec3(0.15, 0, 0) + 0.4 * Vec3(0.3, 0.2, 0)) / 0.7;
  EXPECT_LT((mass.centre - Vec3(-0.05, -0.05, 0.1) - middle).norm(), 1e-15);
  EXPECT_THAT(error_of({bars, "rigid_bodies.lid.filling=shell"}),
              HasSubstr("rigid_bodies.lid.filling: goes with facets; bars are solid"));
}

// A tetrahedron of 1/6 m³ a quarter of its height up, and a bar of pi r² 1 m on its tip, 1.5 m up.
// Of a plate of 1/2 m² times its thickness instead, and a bar of 1 m that stands on a corner.
TEST(RigidBuilder, AddsBarsBesideFacets) {
  const std::string tetrahedron =
      "rigid_bodies.lid.shape={ kind = \"facets\", points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, "
      "0, "
      "1], [0, 0, 2]], facets = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], bars = [[3, 4]] }";
  const std::string triangle =
      "rigid_bodies.lid.shape={ kind = \"facets\", points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, "
      "0, "
      "1]], facets = [[0, 1, 2]], bars = [[0, 3]] }";
  constexpr double kBar = std::numbers::pi * 0.01 * 0.01;  // m³, as thick as the facets
  const auto expect_mass = [](const std::string& shape, double volume, const Vec3& first) {
    const BuiltScene scene = built({shape, "rigid_bodies.lid.thickness=\"20 mm\""});
    const dynamics::MassProperties& mass = body_called("lid", scene).mass;
    EXPECT_NEAR(mass.mass, 1000.0 * volume, 1e-13 * mass.mass);
    EXPECT_LT((mass.centre - Vec3(-0.05, -0.05, 0.1) - first / volume).norm(), 1e-15);
    EXPECT_EQ(scene.scene.elements.cylinders.size(), 1U);
    EXPECT_TRUE(scene.scene.bonds.empty());
  };

  expect_mass(tetrahedron, 1.0 / 6.0 + kBar,
              Vec3::Constant(1.0 / 24.0) + kBar * Vec3(0.0, 0.0, 1.5));
  expect_mass(triangle, 0.01 + kBar,
              0.01 * Vec3(1.0 / 3.0, 1.0 / 3.0, 0.0) + kBar * Vec3(0.0, 0.0, 0.5));
}

TEST(RigidBuilder, RefusesABodyThatIsCalledLikeGrains) {
  EXPECT_THAT(error_of({"rigid_bodies.clump.name=sand"}),
              HasSubstr("\"sand\" is the name of a membrane or of grains too"));
}

}  // namespace
}  // namespace plekton::apps::rigid_builder_test
