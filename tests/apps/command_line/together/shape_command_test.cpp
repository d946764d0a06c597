// SPDX-License-Identifier: GPL-3.0-or-later
// Membranes made from a few numbers, as the user of the program meets them.
#include "apps/scenario/scenario_reader.hpp"
#include "apps/scene/build_scene.hpp"
#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/support/vtp_reader.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

namespace plekton::apps::shape_command_test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr std::string_view kSheet =
    R"(kind = "sheet", width = "1 m", length = "2 m", cells = [10, 20])";
constexpr std::string_view kBiaxial =
    R"(kind = "biaxial_geogrid", rib_pitch = "40 mm", bar_pitch = "50 mm", apertures = [5, 4])";
constexpr std::string_view kUniaxial =
    R"(kind = "uniaxial_geogrid", rib_pitch = "2 cm", bar_pitch = "10 cm", apertures = [10, 3])";
constexpr std::string_view kHexagonal =
    R"(kind = "hexagonal_net", mesh_size = "8 cm", twist_length = "4 cm", wire_height = "3 cm", meshes = [6, 5])";

/// A scenario with a membrane of this shape; its line is 10.
std::string scenario_with(std::string_view shape, std::string_view more = "") {
  return fmt::format(R"([simulation]
duration = "30 ms"
damping = 0.2
[materials.stone]
density = "2650 kg/m3"
young_modulus = "20 MPa"
friction_angle = "35 deg"
[[membranes]]
name = "m"
shape = {{ {} }}
thickness = "4 mm"
material = "stone"
young_modulus = "500 MPa"
areal_mass = "300 g/m2"
{}
)",
                     shape, more);
}

class ShapeCommand : public testing::Test {
 protected:
  /// `plekton check` of such a scenario.
  Outcome checked(std::string_view shape, std::string_view more = "") const {
    test::write_bytes(folder_ / "case.toml", scenario_with(shape, more));
    return outcome_of({"check", (folder_ / "case.toml").string()});
  }
  std::string error_of(std::string_view shape, std::string_view more = "") const {
    const Outcome outcome = checked(shape, more);
    EXPECT_EQ(outcome.exit_code, kFailed) << outcome.out;
    return outcome.err;
  }
  BuiltScene built(std::string_view shape, std::string_view more = "") const {
    return build_scene(parse_scenario(scenario_with(shape, more), folder_ / "case.toml"));
  }

  test::TemporaryFolder folder_;
};

TEST_F(ShapeCommand, CheckCountsWhatEachKindOfSurfaceHas) {
  // Edges of a grid of m x n cells: m (n + 1) + n (m + 1), and 1 diagonal or 4 spokes in each cell.
  constexpr int kSides = 10 * 21 + 20 * 11;
  const auto sheet = [](std::string_view pattern) {
    return fmt::format("{}, pattern = \"{}\"", kSheet, pattern);
  };
  const std::array<std::pair<std::string, std::string>, 7> cases = {{
      // An L of 2 m x 2 m without a square of 1 m: 6 corners, all on the rim.
      {R"(kind = "polygon", points = [[0, 0, 0], [2, 0, 0], [2, 1, 0], [1, 1, 0], [1, 2, 0], [0, 2, 0]])",
       "6 nodes (6 held), 9 beams, 4 facets, area 3 m2"},
      {sheet("diagonal"),
       fmt::format("231 nodes (60 held), {} beams, 400 facets, area 2 m2", kSides + 200)},
      {std::string(kSheet),
       fmt::format("231 nodes (60 held), {} beams, 400 facets, area 2 m2", kSides + 200)},
      {sheet("cross"),
       fmt::format("431 nodes (60 held), {} beams, 800 facets, area 2 m2", kSides + 4 * 200)},
      {R"(kind = "tube", radius = "10 cm", length = "40 cm", cells = [24, 10])",
       "264 nodes (48 held), 744 beams, 480 facets"},
      {R"(kind = "sphere", radius = "1 m", subdivisions = 2)",
       "162 nodes (0 held), 480 beams, 320 facets"},
      {R"(kind = "box", size = ["1 m", "2 m", "30 cm"], cells = [4, 8, 2])",
       "114 nodes (0 held), 336 beams, 224 facets, area 5.8 m2"},
  }};
  for (const auto& [shape, counts] : cases) {
    const bool closed = counts.find("(0 held)") != std::string::npos;
    const Outcome outcome = checked(shape, closed ? "" : "hold = \"rim\"");

    EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("membrane m: " + counts)) << shape;
    EXPECT_THAT(outcome.out, HasSubstr("; generated\n")) << shape;
  }
}

TEST_F(ShapeCommand, CheckCountsWhatEachKindOfNetHas) {
  const auto divided = [](std::string_view shape, int n) {
    return fmt::format("{}, divisions = {}", shape, n);
  };
  const std::array<std::pair<std::string, std::string>, 5> cases = {{
      // 6 ribs of 4 and 5 bars of 5 elements; on the rim all but the 4 x 3 junctions inside
      {std::string(kBiaxial), "30 nodes (18 held), 49 beams, 0 facets, area 0.04 m2"},
      // each element becomes 3, and 2 of the nodes between are on the rim with it
      {divided(kBiaxial, 3), "128 nodes (54 held), 147 beams, 0 facets, area 0.04 m2"},
      // 11 ribs of 3 x 4 elements, 4 bars of 10; the rim is 2 x 11 and, on either side, 2 x 11
      {std::string(kUniaxial), "143 nodes (44 held), 172 beams, 0 facets, area 0.06 m2"},
      // twists 7 + 6 + 7 + 6 + 7; a row of wires is 2 for each of its meshes
      {std::string(kHexagonal), "78 nodes (24 held), 105 beams, 0 facets, area 0.1824 m2"},
      // 12 rings of 16 elements, which share 3 x 3 + 4 x 2 nodes; 14 are where the frame touches
      {R"(kind = "ring_net", ring_diameter = "30 cm", rings = [4, 3], divisions = 4)",
       "175 nodes (14 held), 192 beams, 0 facets, area 1.08 m2"},
  }};
  for (const auto& [shape, counts] : cases) {
    const Outcome outcome = checked(shape, "hold = \"rim\"");

    EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("membrane m: " + counts)) << shape;
  }
}

TEST_F(ShapeCommand, PutsAShapeInItsPlaceAsAMesh) {
  const BuiltScene scene = built(kBiaxial, R"(scale = 2
rotate = { axis = [1, 0, 0], angle = "90 deg" }
translate = [0, 0, "1 m"]
hold = "rim")");

  // 20 cm x 20 cm, twice as large, upright around z = 1 m.
  const BuiltMembrane& net = scene.membranes.at(0);
  EXPECT_DOUBLE_EQ(net.area, 0.16);
  EXPECT_DOUBLE_EQ(net.mass, 0.3 * 0.16);
  EXPECT_EQ(net.held_nodes, 18U);
  constexpr double kRounding = 1e-15;  // of coordinates of 1 m, a few units in the last place
  for (const Vec3& x : scene.scene.state.position) {
    EXPECT_LE(std::abs(x[0]), 0.2 + kRounding);
    EXPECT_LE(std::abs(x[1]), kRounding);
    EXPECT_LE(std::abs(x[2] - 1.0), 0.2 + kRounding);
  }
  for (const geometry::Cylinder& bar : scene.scene.elements.cylinders)
    EXPECT_EQ(bar.radius, 0.002);  // the thickness is not scaled
}

TEST_F(ShapeCommand, NamesAKindThatDoesNotExistWithASuggestion) {
  EXPECT_THAT(error_of("kind = \"shet\""),
              HasSubstr("case.toml:10:18: membranes.m.shape.kind: got \"shet\"; expected one of "
                        "\"sheet\", \"polygon\", \"tube\""));
  EXPECT_THAT(error_of("kind = \"biaxial_geogrd\""),
              HasSubstr("did you mean \"biaxial_geogrid\"?"));
  EXPECT_THAT(error_of("width = 1"), HasSubstr("membranes.m.shape.kind: missing"));
  EXPECT_THAT(
      error_of(""),
      HasSubstr("case.toml:10:9: membranes.m.shape.kind: missing; expected one of "
                "\"sheet\", \"polygon\", \"tube\", \"sphere\", \"box\", \"biaxial_geogrid\", "
                "\"uniaxial_geogrid\", \"hexagonal_net\", \"ring_net\", \"chain\", \"facets\", "
                "\"bars\"\n"));
}

TEST_F(ShapeCommand, ReportsEveryWrongSizeWithItsPlace) {
  const std::string error = error_of(
      R"(kind = "sheet", width = "1 kg", length = "-1 m", cells = [0, 2.5], patern = "cross")");

  EXPECT_THAT(error, HasSubstr("case.toml:10:35: membranes.m.shape.width: got \"1 kg\", a mass; "
                               "expected a length"));
  EXPECT_THAT(error, HasSubstr("case.toml:10:52: membranes.m.shape.length: got \"-1 m\"; expected "
                               "a length above 0"));
  EXPECT_THAT(error, HasSubstr("case.toml:10:69: membranes.m.shape.cells[0]: got 0; expected a "
                               "whole number from 1"));
  EXPECT_THAT(error, HasSubstr("membranes.m.shape.cells[1]: got 2.5; expected a whole number"));
  EXPECT_THAT(error, HasSubstr("patern: unknown key; did you mean \"pattern\"?"));
}

TEST_F(ShapeCommand, RefusesSizesThatGiveNoShape) {
  const std::string_view sheet = R"(kind = "sheet", width = "1 m", length = "1 m", cells = )";
  const std::array<std::pair<std::string, std::string_view>, 15> cases = {{
      {std::string(sheet) + "20", "cells: got 20; expected a list of 2 whole numbers"},
      {std::string(sheet) + "[1, 2, 3]", "expected a list of 2 whole numbers"},
      {std::string(sheet) + "[20000, 20000]",
       "cells: asks for about 8e+08 facets or bars; expected at most 6e+06, which take about 10 "
       "GB; "
       "use fewer and larger ones"},
      {R"(kind = "box", size = ["1 m", "1 m", "1 m"], cells = [100000, 100, 1])",
       "case.toml:10:63: membranes.m.shape.cells: asks for about 4e+07 facets or bars"},
      {R"(kind = "sheet", width = "1e80 m", length = "1 m", cells = [1, 1])",
       "case.toml:10:9: membranes.m: a sheet width of 1e+80 m; expected a positive length below"},
      {R"(kind = "polygon", points = [[0, 0, 0], ["1 m", 0, 0]])",
       "points: got a list of 2; expected a list of at least 3 vectors"},
      {R"(kind = "polygon", points = [[0, 0, 0], ["1 m", "1 m", 0], ["1 m", 0, 0], [0, "1 m", 0]])",
       "case.toml:10:9: membranes.m: a polygon whose sides touch or cross; give its corners in "
       "their order"},
      {R"(kind = "tube", radius = "1 m", length = "1 m", cells = [2, 1])",
       "cells[0]: got 2; expected a whole number from 3"},
      {R"(kind = "sphere", radius = "1 m", subdivisions = 10)",
       "subdivisions: got 10; expected a whole number from 0 to 9"},
      {R"(kind = "box", size = ["1 m", "0 m", "1 m"])",
       "size[1]: got \"0 m\"; expected a length above 0"},
      {R"(kind = "uniaxial_geogrid", rib_pitch = "20 cm", bar_pitch = "10 cm", apertures = [1, 1])",
       "bar_pitch: 0.1 m is not above the rib_pitch of 0.2 m"},
      {R"(kind = "hexagonal_net", mesh_size = "8 cm", twist_length = "4 cm", wire_height = "3 cm", meshes = [1, 5])",
       "meshes[0]: got 1; expected a whole number from 2"},
      {R"(kind = "hexagonal_net", mesh_size = "8 cm", twist_length = "1e-30 m", wire_height = "3 cm", meshes = [2, 1])",
       "case.toml:10:9: membranes.m: \"m\": length of its shortest edge is 0 m"},
      {R"(kind = "ring_net", ring_diameter = "30 cm", rings = [0, 3])",
       "rings[0]: got 0; expected a whole number from 1"},
      {R"(kind = "biaxial_geogrid", rib_pitch = "4 cm", bar_pitch = "4 cm")",
       "apertures: missing; this key is required"},
  }};
  for (const auto& [shape, message] : cases)
    EXPECT_THAT(error_of(shape), HasSubstr(std::string(message))) << shape;
}

TEST_F(ShapeCommand, RefusesKeysThatDoNotGoWithTheShape) {
  EXPECT_THAT(error_of(kSheet, "weld = \"1 um\""),
              HasSubstr("case.toml:15:8: membranes.m.weld: repairs a mesh, and a shape has nothing "
                        "to repair; leave it out"));
  EXPECT_THAT(error_of(kSheet, "wrap = true"), HasSubstr("membranes.m.wrap: repairs a mesh"));
  EXPECT_THAT(error_of(kBiaxial, "mass_mode = \"area\""),
              HasSubstr("case.toml:15:13: membranes.m.mass_mode: a net has no facets to weigh"));
  EXPECT_THAT(error_of(kBiaxial, "sheet_stiffness = \"20 kN/m\""),
              HasSubstr("case.toml:15:19: membranes.m.sheet_stiffness: a net is no sheet; give the "
                        "young_modulus of its bars"));
  EXPECT_THAT(error_of(kBiaxial, "mode = \"continuum\""),
              HasSubstr("case.toml:15:8: membranes.m.mode: a net has no facets that could be a "
                        "sheet; use \"lattice\" or \"truss\""));
  EXPECT_THAT(error_of(kSheet, "bending_stiffness = \"1 N m\""),
              HasSubstr("case.toml:15:21: membranes.m.bending_stiffness: goes with mode = "
                        "\"continuum\""));
  EXPECT_THAT(error_of(kSheet, "mode = \"continuous\""),
              HasSubstr("membranes.m.mode: got \"continuous\""));
  EXPECT_THAT(error_of(R"(kind = "sphere", radius = "1 m", subdivisions = 1)", "hold = \"rim\""),
              HasSubstr("case.toml:15:8: membranes.m.hold: a sphere or box is closed"));
  EXPECT_THAT(error_of(kSheet, "mesh = \"sheet.off\""),
              HasSubstr("shape: got both of mesh and shape; expected exactly one of them"));
}

TEST_F(ShapeCommand, WarnsOfBarsShorterThanThick) {
  const Outcome outcome = checked(fmt::format("{}, divisions = 20", kBiaxial));

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("warning: m: the thickness of 0.004 m exceeds the length of "));
}

TEST_F(ShapeCommand, ChangesAShapeFromTheCommandLine) {
  test::write_bytes(folder_ / "case.toml", scenario_with(kSheet));

  const Outcome outcome = outcome_of(
      {"check", (folder_ / "case.toml").string(), "--set", "membranes.m.shape.cells=[2, 2]"});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("9 nodes (0 held), 16 beams, 8 facets"));
}

TEST_F(ShapeCommand, CheckBuildsEveryShapeOfTheExample) {
  const Outcome outcome =
      outcome_of({"check", PLEKTON_SOURCE_DIR "/apps/examples/import/generators.toml"});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("membrane hexagonal net: 53 nodes (0 held), 70 beams"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("warning")));
}

TEST_F(ShapeCommand, RunLeavesANetAtRestWhoseBarsAreShorterThanThick) {
  // Elements of 2 mm under a thickness of 4 mm: bars overlap that are not neighbours.
  test::write_bytes(folder_ / "case.toml",
                    scenario_with(fmt::format("{}, divisions = 20", kBiaxial)));

  const Outcome outcome =
      outcome_of({"run", (folder_ / "case.toml").string(), "--out", (folder_ / "out").string(),
                  "--set", "simulation.gravity=[0, 0, 0]", "--set", "simulation.duration=1 ms"});

  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
  const auto report = nlohmann::json::parse(test::bytes_of(folder_ / "out/run.json"));
  EXPECT_EQ(report["counts"]["contacts"], 0);
  EXPECT_LT(report["energy"]["kinetic_J"], 1e-15);
}

TEST_F(ShapeCommand, RunCatchesGrainsOnAGeogridAndLetsSmallerOnesThrough) {
  // Clear openings are 36 mm wide; two grains of 50 mm and one of 16 mm above the middle of one.
  test::write_bytes(folder_ / "case.toml",
                    scenario_with(R"(kind = "biaxial_geogrid", rib_pitch = "40 mm", bar_pitch = )"
                                  R"("40 mm", apertures = [5, 5], divisions = 2)",
                                  R"(hold = "rim"
[[grains]]
name = "large"
material = "stone"
count = 2
radius = "25 mm"
placement = "lattice"  # beside each other: the first one at random may leave no room
velocity = [0, 0, "-1 m/s"]
box = { min = ["-7 cm", "-3 cm", "3 mm"], max = ["7 cm", "3 cm", "6 cm"] }
[[grains]]
name = "small"
material = "stone"
count = 1
radius = "8 mm"
velocity = [0, 0, "-4 m/s"]
box = { min = ["-9 mm", "67 mm", "1 cm"], max = ["9 mm", "88 mm", "4 cm"] }
[output]
interval = "30 ms"
)"));
  const std::string out = (folder_ / "out").string();

  const Outcome outcome = outcome_of({"run", (folder_ / "case.toml").string(), "--out", out});

  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
  const auto report = nlohmann::json::parse(test::bytes_of(folder_ / "out/run.json"));
  EXPECT_EQ(report["lost_grains"], 0);
  EXPECT_EQ(report["counts"]["facets"], 0);
  EXPECT_EQ(report["counts"]["cylinders"], 2 * 60);
  EXPECT_LT(report["energy_closure"], 0.005);
  EXPECT_EQ(report["warnings"].size(), 0U);
  const test::VtpReader grains(test::bytes_of(folder_ / "out/frames/grains_00001.vtp"));
  const auto x = grains.values<double>("Points", "Points");
  ASSERT_EQ(x.size(), 9U);
  EXPECT_GT(x[2], 0.0);    // m, z of a large grain
  EXPECT_GT(x[5], 0.0);    // m, of the other one
  EXPECT_LT(x[8], -0.04);  // m, of the small one: 4 m/s x 30 ms less 4 cm at most, with nothing met
  const test::VtpReader net(test::bytes_of(folder_ / "out/frames/membranes_00001.vtp"));
  EXPECT_EQ(net.count("NumberOfLines"), 120U);
  EXPECT_EQ(net.count("NumberOfPolys"), 0U);
}

}  // namespace
}  // namespace plekton::apps::shape_command_test
