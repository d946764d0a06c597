// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/build_scene.hpp"

#include "apps/grains/free_space.hpp"
#include "apps/scenario/scenario_reader.hpp"
#include "dynamics/scene_check.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/io/mesh_file.hpp"
#include "tests/support/temporary_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

namespace plekton::apps::build_scene_test {
namespace {

using dynamics::Held;
using geometry::index_of;
using testing::HasSubstr;

constexpr std::string_view kScenario = R"([simulation]
duration = "1 s"
[materials.gravel]
density = "2650 kg/m3"
young_modulus = "20 MPa"
friction_angle = "35 deg"
[[membranes]]
name = "sheet"
mesh = "sheet.off"
thickness = "2 mm"
material = "gravel"
sheet_stiffness = "20 kN/m"
areal_mass = "300 g/m2"
hold = "rim"
[[grains]]
name = "gravel"
material = "gravel"
count = 50
radius = "5 mm"
box = { min = ["-0.1 m", "-0.1 m", "-2 cm"], max = ["0.1 m", "0.1 m", "3 cm"] }
[[planes]]
point = [0, 0, "-5 cm"]
material = "gravel"
)";

/// A folder with a flat sheet of 0.2 m x 0.3 m, cells of 10 mm and 15 mm, and the scenario above.
class BuildScene : public testing::Test {
 protected:
  BuildScene() {
    geometry::write_mesh_file(folder_ / "sheet.off", geometry::plane_sheet({0.2, 0.3, 20, 20}));
    geometry::write_mesh_file(folder_ / "ball.off", geometry::icosphere(0.05, 1));
  }
  BuiltScene built(const std::vector<std::string>& overrides = {}) {
    return build_scene(parse_scenario(kScenario, folder_ / "case.toml", overrides));
  }
  std::string error_of(const std::vector<std::string>& overrides) {
    try {
      built(overrides);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  test::TemporaryFolder folder_;
};

double total_mass(const dynamics::Scene& scene, std::size_t first, std::size_t count) {
  double mass = 0.0;
  for (std::size_t i = first; i < first + count; ++i) mass += scene.properties.mass[i];
  return mass;
}

/// Rounding of a sum of a few thousand masses.
constexpr double kSum = 1e-12;

TEST_F(BuildScene, MakesAThickMembraneOfAMesh) {
  const BuiltScene scene = built();

  const BuiltMembrane& sheet = scene.membranes.at(0);
  EXPECT_EQ(sheet.nodes, 21U * 21U);
  EXPECT_EQ(sheet.facets, 800U);
  EXPECT_EQ(sheet.beams, 21U * 20U * 2U + 400U);
  EXPECT_EQ(scene.scene.elements.facets.size(), sheet.facets);
  EXPECT_EQ(scene.scene.elements.cylinders.size(), sheet.beams);
  EXPECT_EQ(scene.scene.bonds.size(), sheet.beams);
  for (const geometry::Facet& facet : scene.scene.elements.facets) EXPECT_EQ(facet.radius, 0.001);
  EXPECT_NEAR(sheet.area, 0.06, kSum * 0.06);
}

TEST_F(BuildScene, PutsEachBeamAlongItsCylinder) {
  const BuiltScene scene = built();

  for (std::size_t i = 0; i < scene.scene.bonds.size(); ++i) {
    EXPECT_EQ(scene.scene.bonds[i].nodes, scene.scene.elements.cylinders[i].nodes);
  }
}

TEST_F(BuildScene, GivesTheSheetItsMassInBothModes) {
  for (const char* mode : {"edge", "area"}) {
    const BuiltScene scene = built({std::string("membranes.sheet.mass_mode=") + mode});

    const BuiltMembrane& sheet = scene.membranes.at(0);
    EXPECT_NEAR(sheet.mass, 0.3 * 0.06, kSum * sheet.mass) << mode;
    EXPECT_NEAR(total_mass(scene.scene, sheet.first_node, sheet.nodes), sheet.mass,
                kSum * sheet.mass)
        << mode;
  }
}

TEST_F(BuildScene, GivesTheLatticeTheStiffnessOfTheSheet) {
  const BuiltScene scene = built();

  // Energy per area under the same strain e in all directions: that of a plane-stress sheet of
  // stiffness J and Poisson ratio 1/3.
  double energy = 0.0;
  constexpr double kStrain = 1e-3;
  for (const dynamics::BeamBond& bond : scene.scene.bonds) {
    energy +=
        0.5 * bond.section.young_modulus * bond.section.area * bond.length * kStrain * kStrain;
  }
  const double expected = 20e3 / (1.0 - 1.0 / 3.0) * kStrain * kStrain * 0.06;
  EXPECT_NEAR(energy, expected, kSum * expected);
}

/// A scenario with the material of the one above.
std::string with_gravel(std::string_view bodies) {
  return std::string(kScenario.substr(0, kScenario.find("[[membranes]]"))).append(bodies);
}

/// Two facets, and two bars beside them that are longer than all of their sides.
constexpr std::string_view kFlag = R"([[membranes]]
name = "flag"
shape = { kind = "facets", points = [[0, 0, 0], [0.2, 0, 0], [0.2, 0.2, 0], [0, 0.2, 0], [1, 0, 0], [1, 0.2, 0]], facets = [[0, 1, 2], [0, 2, 3]], bars = [[1, 4], [2, 5]] }
thickness = "10 cm"
material = "gravel"
sheet_stiffness = "20 kN/m"
areal_mass = "300 g/m2"
)";

// Bars beside the facets had their share of what the sheet was to have.
TEST_F(BuildScene, GivesFacetsWithBarsBesideThemTheStiffnessAndMassOfTheSheet) {
  const BuiltScene with_bars =
      build_scene(parse_scenario(with_gravel(kFlag), folder_ / "flag.toml", {}));
  std::string text = with_gravel(kFlag);
  text.erase(text.find(", bars"), std::string_view(", bars = [[1, 4], [2, 5]]").size());
  text.erase(text.find(", [1, 0, 0], [1, 0.2, 0]"),
             std::string_view(", [1, 0, 0], [1, 0.2, 0]").size());
  const BuiltScene without = build_scene(parse_scenario(text, folder_ / "flag.toml", {}));

  EXPECT_DOUBLE_EQ(with_bars.membranes[0].young_modulus, without.membranes[0].young_modulus);
  const double sides = 4 * 0.2 + std::sqrt(0.08), bars = 2 * 0.8;  // m
  EXPECT_NEAR(without.membranes[0].mass, 0.3 * 0.04, kSum);
  EXPECT_NEAR(with_bars.membranes[0].mass, 0.3 * 0.04 * (1.0 + bars / sides), kSum);
}

// Bars beside facets were not in the way.
TEST_F(BuildScene, PlacesGrainsClearOfBarsBesideFacets) {
  std::string text = with_gravel(kFlag);
  text += R"([[grains]]
name = "gravel"
material = "gravel"
count = 60
radius = "1 cm"
box = { min = [0.4, -0.1, -0.1], max = [0.9, 0.3, 0.1] }
)";
  const BuiltScene scene = build_scene(parse_scenario(text, folder_ / "flag.toml", {}));

  ASSERT_EQ(scene.scene.elements.spheres.size(), 60U);
  for (const geometry::Sphere& sphere : scene.scene.elements.spheres) {
    const Vec3& x = scene.scene.state.position[index_of(sphere.nodes[0])];
    for (const double y : {0.0, 0.2}) EXPECT_GE(std::hypot(x[1] - y, x[2]), 0.06 - 1e-15);
  }
}

// The distance was that of the file, in mm.
TEST_F(BuildScene, WarnsInMetresOfAMeshThatIsScaled) {
  geometry::Mesh sheet = geometry::plane_sheet({200.0, 300.0, 20, 20});
  const auto moved = static_cast<geometry::NodeId>(sheet.points.size());
  sheet.points.push_back(sheet.points[30] + Vec3(1e-4, 0.0, 0.0));
  for (auto& facet : sheet.facets) {
    const auto corner = std::ranges::find(facet, geometry::NodeId{30});
    if (corner == facet.end()) continue;
    *corner = moved;
    break;
  }
  geometry::write_mesh_file(folder_ / "in_mm.off", sheet);
  const BuiltScene scene = built({"membranes.sheet.mesh=in_mm.off", "membranes.sheet.scale=0.001"});

  // A millionth of the diagonal.
  EXPECT_THAT(scene.warnings, testing::Contains(HasSubstr("within 3.60555e-07 m of another one")));
}

TEST_F(BuildScene, MakesAThinSheetOfTheFacetsInModeContinuum) {
  for (const char* mode : {"edge", "area"}) {
    const BuiltScene scene =
        built({"membranes.sheet.mode=continuum", std::string("membranes.sheet.mass_mode=") + mode,
               "membranes.sheet.poisson_ratio=0.2"});

    const BuiltMembrane& sheet = scene.membranes.at(0);
    EXPECT_EQ(sheet.beams, 0U);
    EXPECT_TRUE(scene.scene.bonds.empty());
    EXPECT_TRUE(scene.scene.elements.cylinders.empty());
    ASSERT_EQ(scene.scene.sheet_facets.size(), sheet.facets);
    EXPECT_EQ(scene.scene.elements.facets.size(), sheet.facets);
    EXPECT_NEAR(sheet.young_modulus, 20e3 / 2e-3, 1e-6);
    const dynamics::SheetSection& section = scene.scene.sheet_facets[0].section;
    EXPECT_NEAR(section.tensile_stiffness, 20e3, 1e-9);
    EXPECT_NEAR(section.bending_stiffness, 20e3 * 4e-6 / (12.0 * (1.0 - 0.04)), 1e-15);
    EXPECT_NEAR(total_mass(scene.scene, sheet.first_node, sheet.nodes), 0.3 * 0.06,
                kSum * sheet.mass);
    EXPECT_NO_THROW(dynamics::check(scene.scene));
  }
}

TEST_F(BuildScene, WeighsASheetByItsAreaUnlessToldOtherwise) {
  const BuiltScene sheet = built({"membranes.sheet.mode=continuum"});
  const BuiltScene by_area =
      built({"membranes.sheet.mode=continuum", "membranes.sheet.mass_mode=area"});
  EXPECT_EQ(sheet.scene.properties.mass, by_area.scene.properties.mass);
}

TEST_F(BuildScene, LetsNoNodeOfATrussOrALimpSheetTurn) {
  const BuiltScene truss = built({"membranes.sheet.mode=truss"});
  const BuiltScene limp =
      built({"membranes.sheet.mode=continuum", "membranes.sheet.bending_stiffness=0"});
  for (const BuiltScene* scene : {&truss, &limp}) {
    for (std::size_t i = 0; i < scene->membranes[0].nodes; ++i)
      EXPECT_TRUE(dynamics::holds_rotation(scene->scene.properties.held[i]));
  }
  EXPECT_EQ(truss.scene.bonds[0].section.second_moment, 0.0);
  EXPECT_EQ(truss.scene.bonds[0].section.torsion_constant, 0.0);
  EXPECT_EQ(limp.scene.sheet_facets[0].section.bending_stiffness, 0.0);
}

TEST_F(BuildScene, HoldsTheRimOnly) {
  const BuiltScene scene = built();

  EXPECT_EQ(scene.membranes[0].held_nodes, 80U);
  for (std::size_t i = 0; i < scene.membranes[0].nodes; ++i) {
    const Vec3& x = scene.scene.state.position[i];
    const bool on_rim =
        std::abs(std::abs(x[0]) - 0.1) < 1e-9 || std::abs(std::abs(x[1]) - 0.15) < 1e-9;
    EXPECT_EQ(scene.scene.properties.held[i], on_rim ? Held::translation : Held::nothing);
  }
}

TEST_F(BuildScene, HoldsNodesInABoxAndMovesThem) {
  const BuiltScene scene =
      built({"membranes.sheet.hold={min=[0.095, -1, -1], max=[1, 1, 1]}",
             "membranes.sheet.hold_rotation=true", "membranes.sheet.velocity=[\"1 mm/s\", 0, 0]"});

  EXPECT_EQ(scene.membranes[0].held_nodes, 21U);
  for (std::size_t i = 0; i < scene.membranes[0].nodes; ++i) {
    const bool held = scene.scene.state.position[i][0] > 0.095;
    EXPECT_EQ(scene.scene.properties.held[i], held ? Held::everything : Held::nothing);
    EXPECT_EQ(scene.scene.state.velocity[i], Vec3(held ? 0.001 : 0.0, 0.0, 0.0));
  }
}

/// Columns of nodes at multiples of 10 mm, some of them rounded to the outside.
TEST_F(BuildScene, HoldsWhatLiesOnEitherSideOfABox) {
  for (int columns = 1; columns < 10; ++columns) {
    const std::string box = fmt::format(
        "membranes.sheet.hold={{ min = [-0.0{0}, -1, -1], max = [0.0{0}, 1, 1] }}", columns);
    EXPECT_EQ(built({box}).membranes[0].held_nodes, static_cast<std::size_t>(2 * columns + 1) * 21U)
        << columns;
  }
}

TEST_F(BuildScene, ScalesThenTurnsThenMovesAMesh) {
  const BuiltScene scene =
      built({"membranes.sheet.scale=2", "membranes.sheet.rotate={axis=[1, 0, 0], angle=\"90 deg\"}",
             "membranes.sheet.translate=[0, 0, \"1 m\"]"});

  Vec3 lower = Vec3::Constant(1e9), upper = -lower;
  for (std::size_t i = 0; i < scene.membranes[0].nodes; ++i) {
    lower = lower.cwiseMin(scene.scene.state.position[i]);
    upper = upper.cwiseMax(scene.scene.state.position[i]);
  }
  const double rounding = 1e-15;  // of coordinates up to 1.3 m
  EXPECT_LE((lower - Vec3(-0.2, 0.0, 0.7)).norm(), rounding);
  EXPECT_LE((upper - Vec3(0.2, 0.0, 1.3)).norm(), rounding);
}

TEST_F(BuildScene, PlacesGrainsClearOfSheetAndPlane) {
  const BuiltScene scene = built();

  EXPECT_EQ(scene.grains.at(0).count, 50U);
  EXPECT_NEAR(scene.grains[0].mass, 50.0 * 2650.0 * 4.0 / 3.0 * std::numbers::pi * 1.25e-7, kSum);
  for (const geometry::Sphere& sphere : scene.scene.elements.spheres) {
    const Vec3& x = scene.scene.state.position[index_of(sphere.nodes[0])];
    EXPECT_GE(std::abs(x[2]), 0.006 - 1e-15);
  }
}

TEST_F(BuildScene, PlacesTheGrainsOfALaterTableClearOfAnEarlier) {
  std::string text(kScenario);
  text += R"([[grains]]
name = "more"
material = "gravel"
count = 50
radius = "5 mm"
box = { min = ["-0.1 m", "-0.1 m", "-2 cm"], max = ["0.1 m", "0.1 m", "3 cm"] }
)";
  const BuiltScene scene = build_scene(parse_scenario(text, folder_ / "case.toml"));

  const auto& spheres = scene.scene.elements.spheres;
  ASSERT_EQ(spheres.size(), 100U);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 between = scene.scene.state.position[index_of(spheres[i].nodes[0])] -
                           scene.scene.state.position[index_of(spheres[j].nodes[0])];
      EXPECT_GE(between.norm(), 0.01 - 1e-15);
    }
  }
}

TEST_F(BuildScene, TellsTheFrictionCoefficientFromTheAngle) {
  EXPECT_DOUBLE_EQ(built().scene.materials.at(0).friction,
                   std::tan(35.0 * std::numbers::pi / 180.0));
}

TEST_F(BuildScene, PassesTheChecksOfTheScene) {
  EXPECT_NO_THROW(dynamics::check(built().scene));
}

TEST_F(BuildScene, ReportsAllThatOnlyTheFilesShow) {
  test::write_bytes(folder_ / "bad.off", "OFF\n3 1 0\n0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n");

  const std::string error =
      error_of({"membranes.sheet.mesh=bad.off", "grains.gravel.count=100000"});

  EXPECT_THAT(error, HasSubstr("--set membranes.sheet.mesh=bad.off: membranes.sheet: "));
  EXPECT_THAT(error, HasSubstr("bad.off"));
  EXPECT_THAT(error, HasSubstr("case.toml:15:1: grains.gravel: 100000 grains of"));
}

TEST_F(BuildScene, RefusesToHoldWhatIsNotThere) {
  EXPECT_THAT(error_of({"membranes.sheet.mesh=ball.off"}),
              HasSubstr("has no rim to hold: its mesh is closed"));
  EXPECT_THAT(error_of({"membranes.sheet.hold={min=[5, 5, 5], max=[6, 6, 6]}"}),
              HasSubstr("has no node in the box of hold"));
}

TEST_F(BuildScene, RefusesTheRimOfBarsThatHaveNoEnds) {
  constexpr std::string_view kRing = R"([simulation]
duration = "1 s"
[materials.steel]
young_modulus = "20 MPa"
friction_angle = 0
[[membranes]]
name = "ring"
shape = { kind = "bars", points = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], bars = [[0, 1], [1, 2], [2, 0]] }
thickness = "4 mm"
young_modulus = "100 MPa"
density = "2000 kg/m3"
material = "steel"
hold = "rim"
)";
  const auto build = [&] { build_scene(parse_scenario(kRing, folder_ / "ring.toml", {})); };

  EXPECT_THAT(build, testing::ThrowsMessage<std::exception>(
                         HasSubstr("has no rim to hold: none of its points has one bar only")));
}

TEST_F(BuildScene, WarnsOfAThicknessThatDoesNotGoWithTheMesh) {
  const BuiltScene scene = built({"membranes.sheet.thickness=1.2 cm"});

  EXPECT_THAT(
      scene.warnings,
      testing::Contains(HasSubstr("sheet: the thickness of 0.012 m exceeds the length of")));
}

/// Grains inside of a closed ball of 5 cm, in a given way.
constexpr std::string_view kInBall = R"([simulation]
duration = "1 s"
[materials.gravel]
density = "2650 kg/m3"
young_modulus = "20 MPa"
friction_angle = "35 deg"
[[membranes]]
name = "ball"
mesh = "ball.off"
translate = [1, 0, 0]
thickness = "2 mm"
material = "gravel"
sheet_stiffness = "20 kN/m"
areal_mass = "300 g/m2"
[[grains]]
name = "gravel"
material = "gravel"
porosity = 0.8
radius = "4 mm"
inside = "ball"
)";

TEST_F(BuildScene, PlacesGrainsInsideOfAClosedMembraneInEveryWay) {
  for (const std::string placement : {"random", "packed"}) {
    const std::string porosity = placement == "packed" ? "0.5" : "0.8";
    const BuiltScene ball =
        build_scene(parse_scenario(kInBall, folder_ / "case.toml",
                                   std::vector<std::string>{"grains.gravel.placement=" + placement,
                                                            "grains.gravel.porosity=" + porosity}));

    // An icosphere of 80 facets lies within its ball of 5 cm, and holds one of 0.92 of that.
    double solids = 0.0;
    for (const geometry::Sphere& sphere : ball.scene.elements.spheres) {
      const Vec3& centre = ball.scene.state.position[index_of(sphere.nodes[0])];
      EXPECT_LE((centre - Vec3(1.0, 0.0, 0.0)).norm() + sphere.radius, 0.05 - 0.001);
      solids += geometry::volume(sphere);
      for (const geometry::Facet& facet : ball.scene.elements.facets)
        EXPECT_GE(distance_to_triangle(centre, geometry::core(facet, ball.scene.state.position)),
                  (sphere.radius + facet.radius) * (1.0 - 1e-9));
    }
    // Of the volume up to the inner face: V - A t / 2 of the mesh.
    double volume = 0.0;
    for (const geometry::Facet& facet : ball.scene.elements.facets) {
      const auto [a, b, c] = geometry::core(facet, ball.scene.state.position);
      const Vec3 middle(1.0, 0.0, 0.0);
      volume += (a - middle).dot((b - middle).cross(c - middle)) / 6.0 -
                0.5 * (b - a).cross(c - a).norm() * facet.radius;
    }
    // To half of a grain.
    EXPECT_NEAR(solids, (1.0 - std::stod(porosity)) * volume, geometry::ball_volume(0.0041) / 2);
  }
}

TEST_F(BuildScene, RefusesToPlaceGrainsInsideOfWhatIsOpen) {
  const auto problem = [&](const std::string& override) {
    try {
      build_scene(parse_scenario(kInBall, folder_ / "case.toml", std::vector{override}));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };

  EXPECT_THAT(problem("membranes.ball.mesh=sheet.off"),
              HasSubstr("grains.inside: \"ball\" is not closed; expected a surface without a rim"));
  EXPECT_THAT(problem("grains.gravel.inside=bell"),
              HasSubstr("there is no membrane or rigid body called \"bell\"; there are \"ball\""));
}

// It told that no grain found room, and not why. The box is from 2 cm below to 3 cm above the sheet.
TEST_F(BuildScene, SaysWhatTakesUpTheSpaceWhereGrainsFindNoRoom) {
  EXPECT_THAT(error_of({"planes.0.normal=[0, 0, -1]"}),
              HasSubstr("; 100 % of it is behind planes[0]: turn its normal, which points to the "
                        "side where bodies may be, or move it"));
  EXPECT_THAT(error_of({"planes.0.point=[0, 0, 0.1]"}), HasSubstr("100 % of it is behind"));
  EXPECT_THAT(
      error_of({"planes.0.kind=cylinder", "planes.0.radius=1 cm", "planes.0.point=[1, 0, 0]"}),
      HasSubstr("100 % of it is outside of planes[0]: move or widen that"));
  EXPECT_THAT(error_of({"membranes.sheet.thickness=1 m"}),
              HasSubstr("100 % of it is taken up by membranes.sheet with its thickness of 1 m"));
  // 0.27 of the box, which is more than chance allows: nothing is in the way.
  EXPECT_THAT(error_of({"grains.gravel.count=5000"}), testing::Not(HasSubstr("% of it is")));
}

TEST_F(BuildScene, TakesGrainsFromATable) {
  test::write_bytes(folder_ / "soil.csv", "x (mm),y (mm),z (mm),r (mm)\n1,2,3,4\n-10,0,0,5\n");
  std::string text(kScenario);
  const std::string keys =
      "count = 50\nradius = \"5 mm\"\nbox = { min = [\"-0.1 m\", \"-0.1 m\", "
      "\"-2 cm\"], max = [\"0.1 m\", \"0.1 m\", \"3 cm\"] }\n";
  const std::size_t place = text.find(keys);
  ASSERT_NE(place, std::string::npos);
  const std::string with_table =
      std::string(text).replace(place, keys.size(), "table = \"soil.csv\"\n");

  const BuiltScene scene = build_scene(parse_scenario(with_table, folder_ / "case.toml"));

  ASSERT_EQ(scene.grains[0].count, 2U);
  EXPECT_NEAR(scene.scene.elements.spheres[0].radius, 4e-3, 1e-15);
  const auto node = index_of(scene.scene.elements.spheres[1].nodes[0]);
  EXPECT_NEAR((scene.scene.state.position[node] - Vec3(-0.01, 0.0, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_THROW(
      parse_scenario(std::string(with_table).replace(with_table.find("soil.csv"), 8, "sail.csv"),
                     folder_ / "case.toml"),
      InputError);
  EXPECT_THROW(parse_scenario(std::string(text).replace(place, 0, "table = \"soil.csv\"\n"),
                              folder_ / "case.toml"),
               InputError);
}

}  // namespace
}  // namespace plekton::apps::build_scene_test
