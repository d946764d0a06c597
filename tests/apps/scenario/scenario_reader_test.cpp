// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/scenario_reader.hpp"

#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <limits>
#include <numbers>

namespace plekton::apps::scenario_reader_test {
namespace {

using testing::HasSubstr;

constexpr std::string_view kGood = R"([simulation]
duration = "2 s"
gravity = [0, 0, "-9.81 m/s2"]

[materials.gravel]
density = "2650 kg/m3"
young_modulus = "20 MPa"
friction_angle = "35 deg"

[[grains]]
name = "gravel"
material = "gravel"
count = 10
sieves = [{ sieve = "6 mm", passing = 0 }, { sieve = "8 mm", passing = "30 %" }, { sieve = "16 mm", passing = 1 }]
box = { min = ["0 m", "0 m", "0 m"], max = ["10 cm", "10 cm", "10 cm"] }

[[planes]]
name = "floor"
point = [0, 0, 0]
normal = [0, 0, 2]
material = "gravel"
)";

/// kGood with one text replaced by another.
std::string edited(std::string_view before, std::string_view after) {
  std::string text(kGood);
  const std::size_t at = text.find(before);
  if (at == std::string::npos) throw std::logic_error("not in the file: " + std::string(before));
  return text.replace(at, before.size(), after);
}

std::string error_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_scenario(text, "case.toml", overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

auto lines_in(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n') + 1;
}

TEST(ScenarioReader, ReadsValuesInSiUnits) {
  const Scenario scenario = parse_scenario(kGood, "case.toml");

  EXPECT_EQ(scenario.simulation.duration, 2.0);
  EXPECT_EQ(scenario.simulation.gravity, Vec3(0.0, 0.0, -9.81));
  EXPECT_FALSE(scenario.simulation.time_step);
  ASSERT_EQ(scenario.materials.size(), 1U);
  EXPECT_EQ(scenario.materials[0].young_modulus, 20e6);
  EXPECT_DOUBLE_EQ(scenario.materials[0].friction_angle, 35.0 * std::numbers::pi / 180.0);
  ASSERT_EQ(scenario.grains.size(), 1U);
  EXPECT_EQ(std::get<std::size_t>(scenario.grains[0].amount), 10U);
  EXPECT_EQ(scenario.grains[0].sizes.largest_diameter(), 0.016);
  EXPECT_EQ(scenario.grains[0].box.upper, Vec3::Constant(0.1));
  EXPECT_EQ(scenario.planes[0].normal, Vec3(0.0, 0.0, 1.0));
}

// The mark was a character beyond ASCII, also in the copy of a run, where something is before it.
TEST(ScenarioReader, TakesATextWithAByteOrderMarkForTheSameWithout) {
  const std::string marked = "\xEF\xBB\xBF" + std::string(kGood);
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "case.toml", marked);

  EXPECT_EQ(error_of(marked), "");
  EXPECT_EQ(read_scenario(folder / "case.toml", {}).text, kGood);
}

TEST(ScenarioReader, HasDefaultsThatFollowTheDuration) {
  const Scenario scenario = parse_scenario(kGood, "case.toml");

  EXPECT_EQ(scenario.output.interval, 0.02);
  EXPECT_EQ(scenario.output.history_interval, 0.002);
  EXPECT_FALSE(scenario.stop);
}

TEST(ScenarioReader, NamesATypoWithPlaceAndSuggestion) {
  EXPECT_THAT(
      error_of(edited("duration", "duraton")),
      HasSubstr("case.toml:2:1: simulation.duraton: unknown key; did you mean \"duration\"?"));
  EXPECT_THAT(error_of(edited("[[planes]]", "[[plane]]")),
              HasSubstr("plane: unknown key; did you mean \"planes\"?"));
  EXPECT_THAT(error_of(edited("count = 10", "count = 10\ncolour = 1")),
              HasSubstr("grains.gravel.colour: unknown key; known here: "));
}

TEST(ScenarioReader, NamesAWrongUnit) {
  EXPECT_THAT(error_of(edited("20 MPa", "20 mm")),
              HasSubstr("case.toml:7:17: materials.gravel.young_modulus: got \"20 mm\", a length; "
                        "expected a pressure"));
}

TEST(ScenarioReader, RefusesANegativeRadius) {
  const std::string text = edited(
      "sieves = [{ sieve = \"6 mm\", passing = 0 }, { sieve = \"8 mm\", passing = \"30 %\" }, "
      "{ sieve = \"16 mm\", passing = 1 }]",
      "radius = \"-5 mm\"");
  EXPECT_THAT(error_of(text),
              HasSubstr("grains.gravel.radius: got \"-5 mm\"; expected a length above 0"));
}

TEST(ScenarioReader, RefusesAFrictionAngleOf95Degrees) {
  EXPECT_THAT(error_of(edited("35 deg", "95 deg")),
              HasSubstr("materials.gravel.friction_angle: got \"95 deg\"; expected an angle from 0 "
                        "deg to below 90 deg"));
}

TEST(ScenarioReader, AsksBackWhenAnAngleHasNoUnit) {
  EXPECT_THAT(
      error_of(edited("\"35 deg\"", "35")),
      HasSubstr(
          "got 35 rad; expected an angle from 0 deg to below 90 deg; did you mean \"35 deg\"?"));
}

// A mesh was turned by 90 rad.
TEST(ScenarioReader, AsksBackWhenABodyIsTurnedByMoreThanATurn) {
  const auto turned = [](const std::string& angle) {
    return std::string(kGood) +
           "[[membranes]]\nname = \"sheet\"\nthickness = 0.002\nmaterial = \"gravel\"\n"
           "shape = { kind = \"sheet\", width = 1, length = 1, cells = [2, 2] }\n"
           "young_modulus = 5e7\nareal_mass = 0.3\nrotate.angle = " +
           angle + "\n";
  };

  EXPECT_THAT(error_of(turned("90")),
              HasSubstr("membranes.sheet.rotate.angle: got 90 rad; expected an angle from -360 deg "
                        "to 360 deg; did you mean \"90 deg\"?"));
  EXPECT_THAT(error_of(turned("-6.3")), HasSubstr("did you mean \"-6.3 deg\"?"));
  for (const char* angle : {"1.5", "\"360 deg\"", "\"-360 deg\"", "6.283185307179586"})
    EXPECT_EQ(error_of(turned(angle)), "") << angle;
}

TEST(ScenarioReader, NamesAMaterialThatDoesNotExist) {
  EXPECT_THAT(
      error_of(edited("material = \"gravel\"", "material = \"gravle\"")),
      HasSubstr(
          "grains.gravel.material: there is no material \"gravle\"; did you mean \"gravel\"?"));
  EXPECT_THAT(error_of(edited("material = \"gravel\"", "material = \"steel\"")),
              HasSubstr("the materials are \"gravel\""));
}

TEST(ScenarioReader, NamesAMeshThatDoesNotExist) {
  const std::string text = std::string(kGood) + R"([[membranes]]
name = "sheet"
mesh = "sheet.stl"
thickness = "2 mm"
material = "gravel"
young_modulus = "50 MPa"
areal_mass = "300 g/m2"
)";
  EXPECT_THAT(error_of(text),
              HasSubstr("case.toml:24:8: membranes.sheet.mesh: \"sheet.stl\" does not exist"));
}

TEST(ScenarioReader, ReportsAllProblemsAtOnceInTheOrderOfTheFile) {
  std::string text = edited("duration = \"2 s\"", "duration = \"2 kg\"");
  text.replace(text.find("35 deg"), 6, "95 deg");
  text.replace(text.find("count"), 5, "coutn");

  const std::string error = error_of(text);

  EXPECT_EQ(lines_in(error), 4) << error;  // the missing count is one, the unknown coutn another
  EXPECT_LT(error.find("case.toml:2:12"), error.find("case.toml:8:18"));
  EXPECT_LT(error.find("case.toml:8:18"), error.find("case.toml:13:1"));
}

TEST(ScenarioReader, RefusesSieveTablesThatDoNotRise) {
  EXPECT_THAT(error_of(edited("\"8 mm\"", "\"5 mm\"")),
              HasSubstr("grains.gravel.sieves[1].sieve: 0.005 m is not above 0.006 m"));
  EXPECT_THAT(error_of(edited("passing = 1 ", "passing = 0.2 ")),
              HasSubstr("sieves[2].passing: 0.2 is below 0.3"));
  EXPECT_THAT(error_of(edited("passing = 1 ", "passing = 0.9 ")),
              HasSubstr("passing goes from 0 to 0.9; expected from 0"));
  EXPECT_THAT(error_of(edited("passing = 0 ", "passing = 0.1 ")),
              HasSubstr("passing goes from 0.1 to 1"));
  EXPECT_THAT(error_of(edited("passing = 1 ", "passing = 1.5 ")),
              HasSubstr("got 1.5; expected a number without unit from 0 to 1"));
  EXPECT_THAT(error_of(edited("\"6 mm\"", "\"0 mm\"")),
              HasSubstr("got \"0 mm\"; expected a length above 0"));
}

TEST(ScenarioReader, RefusesGrainsWithoutOrWithTwoAmounts) {
  EXPECT_THAT(
      error_of(edited("count = 10", "")),
      HasSubstr("got 0 of \"count\", \"mass\", \"volume\", \"porosity\"; expected exactly one"));
  EXPECT_THAT(error_of(edited("count = 10", "count = 10\nmass = \"1 kg\"")), HasSubstr("got 2 of"));
  EXPECT_THAT(error_of(edited("count = 10", "count = 0")),
              HasSubstr("got 0; expected a whole number from 1"));
  EXPECT_THAT(error_of(edited("count = 10", "count = 10\nradius = \"1 mm\"")),
              HasSubstr("got both of radius and sieves"));
}

TEST(ScenarioReader, RefusesGrainsOfAMaterialWithoutDensity) {
  EXPECT_THAT(error_of(edited("density = \"2650 kg/m3\"\n", "")),
              HasSubstr("grains.gravel.material: material \"gravel\" has no density"));
}

TEST(ScenarioReader, RefusesABoxInsideOut) {
  EXPECT_THAT(error_of(edited("[\"10 cm\", \"10 cm\"", "[\"10 cm\", \"-10 cm\"")),
              HasSubstr("grains.gravel.box.max: component y is -0.1 m"));
}

TEST(ScenarioReader, RefusesABoxBeyondAllNumbers) {
  EXPECT_THAT(error_of(edited("min = [\"0 m\"", "min = [-1e308")), testing::IsEmpty());
  EXPECT_THAT(error_of(edited("min = [\"0 m\", \"0 m\", \"0 m\"], max = [\"10 cm\"",
                              "min = [-1e308, 0, 0], max = [1e308")),
              HasSubstr("further from -1e+308 m of min"));
}

TEST(ScenarioReader, RefusesNumbersThatAreNotFinite) {
  EXPECT_THAT(error_of(edited("[0, 0, \"-9.81 m/s2\"]", "[0, nan, inf]")),
              HasSubstr("simulation.gravity[1]: got nan"));
  EXPECT_THAT(error_of(edited("count = 10", "count = nan")),
              HasSubstr("grains.gravel.count: got nan; expected a whole number"));
}

TEST(ScenarioReader, RefusesValuesOfAnotherKind) {
  EXPECT_THAT(error_of(edited("[0, 0, \"-9.81 m/s2\"]", "-9.81")),
              HasSubstr("got -9.81; expected a list of three components"));
  EXPECT_THAT(error_of(edited("[[planes]]", "[planes]")),
              HasSubstr("planes: got a table; expected a list of tables, each under [[planes]]"));
  EXPECT_THAT(error_of(edited("\"2 s\"", "2026-01-01")),
              HasSubstr("got a date or time of day; expected a time"));
  EXPECT_THAT(error_of(edited("\"2 s\"", "true")), HasSubstr("got true; expected a time"));
}

/// A cell of two ends and a side, two planes more, and a ball, behind kGood with its floor.
constexpr const char* kContainer = R"(
[[planes]]
name = "cell"
kind = "cylinder"
point = [0, 0, 0]
radius = 1
material = "gravel"
[[planes]]
name = "ball"
kind = "sphere"
point = [0, 0, 0]
radius = 1
material = "gravel"
[[planes]]
name = "lid"
point = [0, 0, 1]
normal = [0, 0, -1]
material = "gravel"
[[planes]]
name = "left"
point = [-1, 0, 0]
normal = [1, 0, 0]
material = "gravel"
[[planes]]
name = "right"
point = [1, 0, 0]
normal = [-1, 0, 0]
material = "gravel"
)";

TEST(ScenarioReader, ReadsContainersAsPlanes) {
  const Scenario scenario =
      parse_scenario(edited("normal = [0, 0, 2]",
                            "kind = \"cylinder\"\naxis = [0, 2, 0]\nradius = \"5 cm\"\n"
                            "angular_velocity = \"180 deg/s\""),
                     "case.toml");

  const PlaneSettings& drum = scenario.planes[0];
  EXPECT_EQ(drum.form, contact::Plane::Form::cylinder);
  EXPECT_EQ(drum.axis, Vec3(0.0, 1.0, 0.0));
  EXPECT_DOUBLE_EQ(drum.radius, 0.05);
  EXPECT_NEAR(drum.angular_velocity, std::numbers::pi, 1e-15);
}

TEST(ScenarioReader, KnowsWhatBelongsToEachKindOfPlane) {
  EXPECT_THAT(error_of(edited("normal = [0, 0, 2]", "kind = \"sphere\"")),
              HasSubstr("planes.floor.radius: missing"));
  EXPECT_THAT(error_of(edited("normal = [0, 0, 2]",
                              "kind = \"sphere\"\nnormal = [0, 0, 1]\n"
                              "radius = 1")),
              HasSubstr("planes.floor.normal: unknown key"));
  EXPECT_THAT(error_of(edited("normal = [0, 0, 2]", "radius = 1")),
              HasSubstr("planes.floor.radius: unknown key"));
  EXPECT_THAT(error_of(edited("normal = [0, 0, 2]",
                              "kind = \"cylinder\"\naxis = [0, 0, 0]\n"
                              "radius = 1")),
              HasSubstr("planes.floor.axis: got a vector of no length; expected the direction"));
  EXPECT_THAT(error_of(edited("normal = [0, 0, 2]", "kind = \"cone\"")),
              HasSubstr("planes.floor.kind"));
}

TEST(ScenarioReader, RefusesDistancesAndMeasuresOfContainers) {
  const std::string text = std::string(kGood) + kContainer;

  EXPECT_THAT(error_of(text + "[stop]\nstrain = { between = [\"cell\", \"lid\"], strain = 0.1 }\n"),
              HasSubstr("planes \"cell\" and \"lid\" are not flat and parallel"));
  EXPECT_THAT(error_of(text + "[[output.measures]]\nname = \"m\"\nbetween = [\"cell\"]\n"),
              HasSubstr("container \"cell\" and the region differ in shape or middle"));
  const std::string around = text + "[[output.measures]]\nname = \"m\"\nbetween = [\"cell\"]\n";
  EXPECT_EQ(error_of(around + "cylinder = { from = [0, 0, 0], to = [0, 0, 1], radius = 2 }\n"), "");
  EXPECT_THAT(error_of(around + "cylinder = { from = [0, 0, 0], to = [0, 1, 1], radius = 2 }\n"),
              HasSubstr("container \"cell\" and the region differ in shape or middle"));
}

TEST(ScenarioReader, BoundsTheSideOfACylinderByThePlanesAtItsEnds) {
  const auto servo = [](const std::string& plane, const std::string& rest) {
    return std::string(kGood) + kContainer + "[[loads]]\nkind = \"servo\"\nplane = \"" + plane +
           "\"\npressure = \"1 kPa\"\nspeed = \"1 m/s\"\n" + rest;
  };

  EXPECT_EQ(error_of(servo("cell", "between = [\"floor\", \"lid\"]\n")), "");
  EXPECT_EQ(error_of(servo("cell", "area = \"1 m2\"\n")), "");
  EXPECT_EQ(error_of(servo("ball", "area = \"1 m2\"\n")), "");
  EXPECT_THAT(
      error_of(servo("cell", "between = [\"floor\", \"lid\", \"left\", \"right\"]\n")),
      HasSubstr("\"cell\" is a cylinder; expected the names of the two planes at its ends"));
  EXPECT_THAT(
      error_of(servo("cell", "between = [\"left\", \"right\"]\n")),
      HasSubstr("\"cell\" is a cylinder; expected the names of the two planes at its ends"));
  EXPECT_THAT(error_of(servo("ball", "between = [\"floor\", \"lid\"]\n")),
              HasSubstr("\"ball\" is a sphere; expected its area"));
}

constexpr const char* kFrontAndBack = R"(
[[planes]]
name = "front"
point = [0, -1, 0]
normal = [0, 1, 0]
material = "gravel"
[[planes]]
name = "back"
point = [0, 1, 0]
normal = [0, -1, 0]
material = "gravel"
)";

TEST(ScenarioReader, BoundsAPlateByTwoPairsOfPlanesAroundIt) {
  const std::string body =
      "[[rigid_bodies]]\nname = \"box\"\nspheres = [{ centre = [0, 0, 0.5], radius = 0.1 }]\n"
      "material = \"gravel\"\nmass = 1\n";
  const auto servo = [&](const std::string& what, const std::string& between) {
    return error_of(std::string(kGood) + kContainer + kFrontAndBack + body +
                    "[[loads]]\nkind = \"servo\"\npressure = \"1 kPa\"\nspeed = \"1 m/s\"\n" +
                    what + "\nbetween = [" + between + "]\n");
  };
  const std::string around = R"("left", "right", "front", "back")";

  for (const std::string what : {"plane = \"lid\"", "rigid_body = \"box\"\ndirection = \"-z\""}) {
    EXPECT_EQ(servo(what, around), "");
    EXPECT_THAT(
        servo(what, R"("left", "right")"),
        HasSubstr("between: got one pair of planes, whose distance is no area; expected the "
                  "two pairs of planes that bound"));
    for (const char* pair : {R"("left", "right")", R"("floor", "lid")"})
      EXPECT_THAT(servo(what, std::string(R"("right", "left", )") + pair),
                  HasSubstr("whose normals and the direction of the servo lie in one plane"));
  }
  EXPECT_EQ(servo("rigid_body = \"box\"\ndirection = \"x\"", R"("floor", "lid", "front", "back")"),
            "");
}

TEST(ScenarioReader, SaysNothingMoreOfAServoOnAPlaneThatIsNotThere) {
  const std::string error =
      error_of(edited("normal = [0, 0, 2]", "kind = \"cylinder\"\nradius = 1") + kContainer +
               "[[loads]]\nkind = \"servo\"\nplane = \"cel\"\npressure = \"1 kPa\"\n"
               "speed = \"1 m/s\"\nbetween = [\"left\", \"right\"]\n");

  EXPECT_THAT(error, HasSubstr("there is none called \"cel\""));
  EXPECT_THAT(error, testing::Not(HasSubstr("is a cylinder")));
}

TEST(ScenarioReader, RefusesTwoOfTheSameName) {
  const std::string text =
      std::string(kGood) +
      "[[planes]]\nname = \"floor\"\npoint = [0, 0, 0]\nmaterial = \"gravel\"\n";

  EXPECT_THAT(error_of(text), HasSubstr("planes.floor.name: \"floor\" has this name already"));
}

TEST(ScenarioReader, NamesWhatATableLacks) {
  EXPECT_THAT(error_of(edited("duration = \"2 s\"", "")),
              HasSubstr("case.toml:1:1: simulation.duration: missing"));
  EXPECT_THAT(error_of(edited("point = [0, 0, 0]", "")), HasSubstr("planes.floor.point: missing"));
  EXPECT_THAT(error_of(""), HasSubstr("case.toml:1:1: simulation: missing"));
}

TEST(ScenarioReader, RefusesAScenarioWithNothingInIt) {
  EXPECT_THAT(error_of("[simulation]\nduration = \"1 s\"\n"), HasSubstr("nothing to simulate"));
}

TEST(ScenarioReader, KnowsAStudyAndNamesItsCommand) {
  const std::string study = "jobs = 2\nscenario = \"case.toml\"\n[grid]\na = [1]\n";
  EXPECT_THAT(error_of(study), HasSubstr("case.toml:2:1: scenario: this file is a study"));
  EXPECT_THAT(error_of(study), HasSubstr("`plekton study`"));
  EXPECT_THAT(error_of(study), Not(HasSubstr("missing")));
}

TEST(ScenarioReader, KnowsAMeshAndNamesTheCommandAndTheKeyForIt) {
  const test::TemporaryFolder folder;
  const std::string mesh = (folder / "ball.STL").string();
  test::write_bytes(mesh, "solid ball\nendsolid ball\n");
  try {
    read_scenario(mesh);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              mesh + ": a mesh; expected a scenario (.toml), which names it as mesh = \"" + mesh +
                  "\"; \"plekton import " + mesh + "\" says what is in it");
  }
}

TEST(ScenarioReader, NamesThePlaceOfAnErrorOfSyntax) {
  EXPECT_THAT(error_of(edited("duration = ", "duration ")), HasSubstr("case.toml:2:"));
  EXPECT_THAT(error_of(edited("duration = ", "duration ")), HasSubstr("not TOML"));
}

TEST(ScenarioReader, RefusesTablesNestedWithoutEnd) {
  std::string key = "a";
  for (int i = 0; i < 20'000; ++i) key += ".a";

  EXPECT_THAT(error_of(edited("duration", key + " = 1\nduration")),
              HasSubstr("nested more than 32 deep"));
}

TEST(ScenarioReader, ListsEveryKnownKeyOnce) {
  EXPECT_THAT(error_of(edited("density", "colour = 1\ndensity")),
              HasSubstr("known here: \"density\", \"young_modulus\""));
}

TEST(ScenarioReader, ChecksAnOverrideAsIfItStoodInTheFile) {
  const std::vector<std::string> good = {"grains.gravel.count=7", "simulation.duration=1 min"};
  EXPECT_EQ(parse_scenario(kGood, "case.toml", good).simulation.duration, 60.0);
  EXPECT_THAT(
      error_of(std::string(kGood), {"simulation.duration=1 kg"}),
      HasSubstr("--set simulation.duration=1 kg: simulation.duration: got \"1 kg\", a mass"));
  EXPECT_THAT(error_of(std::string(kGood), {"simulation.duratoin=1 s"}),
              HasSubstr("unknown key; did you mean \"duration\"?"));
}

TEST(ScenarioReader, TakesGrainsByMass) {
  const Scenario scenario = parse_scenario(edited("count = 10", "mass = \"5.3 kg\""), "case.toml");

  EXPECT_DOUBLE_EQ(std::get<double>(scenario.grains[0].amount), 0.002);  // m³ of solids
}

TEST(ScenarioReader, LimitsTheNumberOfGrainsHoweverItIsGiven) {
  // Grains of at most 8 mm and at least 3 mm radius; 1e8 of them are between 1e1 and 3e2 m3.
  EXPECT_THAT(error_of(edited("count = 10", "count = 100000001")),
              HasSubstr("expected a whole number from 1 to 100000000"));
  EXPECT_THAT(error_of(edited("count = 10", "volume = \"300 m3\"")),
              HasSubstr("case.toml:13:10: grains.gravel.volume: makes about"));
  EXPECT_THAT(error_of(edited("count = 10", "mass = \"800 t\"")),
              HasSubstr("grains of these sizes; expected at most 100000000"));
  EXPECT_EQ(error_of(edited("count = 10", "volume = \"10 m3\"")), "");
}

TEST(ScenarioReader, RefusesNamesThatASpreadsheetTakesForFormulas) {
  for (const std::string name : {"=1+1", "+1", "-1", "@sum"}) {
    const std::string error = error_of(edited("name = \"floor\"", "name = \"" + name + "\""));
    EXPECT_THAT(error, HasSubstr("planes." + name + ".name: got \"" + name + "\"")) << error;
    EXPECT_THAT(error, HasSubstr("formula"));
  }
  EXPECT_EQ(error_of(edited("name = \"floor\"", "name = \"floor=1-1\"")), "");
}

TEST(ScenarioReader, GivesGrainsWithoutSeedDifferentOnes) {
  const std::string text = std::string(kGood) + R"([[grains]]
material = "gravel"
count = 10
radius = "1 mm"
box = { min = [0, 0, 0], max = [1, 1, 1] }
)";
  const Scenario scenario = parse_scenario(text, "case.toml");

  EXPECT_NE(scenario.grains[0].seed, scenario.grains[1].seed);
}

TEST(ScenarioReader, FindsMeshesRelativeToTheScenario) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "sheet.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  test::write_bytes(folder / "case.toml", std::string(kGood) + R"([[membranes]]
name = "sheet"
mesh = "sheet.off"
thickness = "2 mm"
material = "gravel"
sheet_stiffness = "20 kN/m"
areal_mass = "300 g/m2"
hold = { min = [0, 0, -1], max = [1, 0, 1] }
)");

  const Scenario scenario =
      read_scenario(folder / "case.toml", std::vector<std::string>{"membranes.sheet.hold=rim"});

  ASSERT_EQ(scenario.membranes.size(), 1U);
  EXPECT_EQ(scenario.membranes[0].mesh, folder / "sheet.off");
  EXPECT_EQ(scenario.membranes[0].hold.which, HoldWhich::rim);
  EXPECT_FALSE(scenario.membranes[0].young_modulus);
  EXPECT_EQ(scenario.membranes[0].sheet_stiffness, 20e3);
}

TEST(ScenarioReader, ReadsHowGrainsArePlaced) {
  const auto placement_of = [](const std::string& line) {
    return parse_scenario(edited("count = 10\n", "count = 10\n" + line), "case.toml")
        .grains.at(0)
        .placement;
  };

  EXPECT_EQ(placement_of(""), GrainPlacement::random);
  EXPECT_EQ(placement_of("placement = \"random\"\n"), GrainPlacement::random);
  EXPECT_EQ(placement_of("placement = \"lattice\"\n"), GrainPlacement::lattice);
  EXPECT_THAT(error_of(edited("count = 10\n", "count = 10\nplacement = \"latice\"\n")),
              HasSubstr("case.toml:14:13: grains.gravel.placement: got \"latice\"; expected one of "
                        "\"random\", \"lattice\", \"packed\"; did you mean \"lattice\"?"));
}

/// Materials, each with a pair of its own, and as many planes.
std::string scenario_of(int count) {
  std::string text(kGood);
  for (int i = 0; i < count; ++i) {
    const std::string name = "m" + std::to_string(i);
    text += "[materials." + name + "]\nyoung_modulus = 1e7\nfriction_angle = 0.5\n[[contacts]]\n" +
            "between = \"" + name + "\"\nand = \"gravel\"\n[[planes]]\nname = \"" + name +
            "\"\npoint = [0, 0, 0]\nmaterial = \"" + name + "\"\n";
  }
  return text;
}

/// s of processor time, the least of three.
double time_to_read(int count) {
  const std::string text = scenario_of(count);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const std::clock_t start = std::clock();
    parse_scenario(text, "case.toml");
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

/// Eight times as many tables: a bit more than eight times the time, and 64 times if every table
/// looked at all others.
TEST(ScenarioReader, TakesTimeAboutInProportionToTheNumberOfTables) {
  EXPECT_LT(time_to_read(8000), 20.0 * time_to_read(1000));
}

TEST(ScenarioReader, RefusesAMissingFileAndAFolder) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(read_scenario(folder / "none.toml"), InputError);
  EXPECT_THROW(read_scenario(folder.path()), InputError);
}

/// What the parser of TOML (3.3) takes for impossible or does anything with.
TEST(ScenarioReader, RefusesTextsThatItsParserIsNotMadeFor) {
  EXPECT_THAT(error_of("[)"), HasSubstr("not TOML"));
  EXPECT_THAT(error_of("[[ ,]]\na = 1"), HasSubstr("not TOML"));
  EXPECT_THAT(error_of("[simulation]\n[a\xD2\x89"
                       "b]\n"),
              HasSubstr("case.toml:2:3: not TOML: a character beyond ASCII outside of quotes"));
  EXPECT_THAT(error_of("[simulation]\nd\xC3\xA9 = 1\n"), HasSubstr("case.toml:2:2: not TOML"));
}

// All were a character beyond ASCII, to be put in quotes.
TEST(ScenarioReader, NamesWhatOtherProgramsMakeOfAText) {
  EXPECT_THAT(error_of("[simulation]\nduration = \xE2\x80\x9C"
                       "1 s\xE2\x80\x9D\n"),
              HasSubstr("case.toml:2:12: not TOML: a typographic quote, as word processors and web "
                        "pages make of plain ones; write \" or '"));
  EXPECT_THAT(error_of("# \xC3\xA9\n[simulation]\nduration = \xC2\xAB"
                       "1 s\xC2\xBB\n"),
              HasSubstr("case.toml:3:12: not TOML: a typographic quote"));
  EXPECT_THAT(error_of("[simulation]\nduration\xC2\xA0= 1\n"),
              HasSubstr("case.toml:2:9: not TOML: a no-break space"));
  const std::string utf16 = {'\xFF', '\xFE', '[', '\0', 's', '\0', ']', '\0'};
  EXPECT_THAT(error_of(utf16), HasSubstr("case.toml: not TOML: is text in UTF-16"));
  EXPECT_THAT(error_of(utf16.substr(2)), HasSubstr("save it as UTF-8"));
}

TEST(ScenarioReader, TakesAnyCharacterInQuotesCommentsAndOverrides) {
  const std::string text =
      "\xEF\xBB\xBF# K\xC3\xB6rner\n" + edited("name = \"gravel\"", "name = \"K\xC3\xB6rner\"");
  EXPECT_EQ(parse_scenario(text, "case.toml").grains.front().name, "K\xC3\xB6rner");

  const std::vector<std::string> overrides = {"grains.gravel.name=K\xC3\xB6rner"};
  EXPECT_EQ(parse_scenario(kGood, "case.toml", overrides).grains.front().name, "K\xC3\xB6rner");
}

TEST(ScenarioReader, RefusesSievesThatAreTooExtremeToComputeWith) {
  EXPECT_THAT(error_of(edited("{ sieve = \"16 mm\"", "{ sieve = 1e200")),
              HasSubstr("sizes from 0.006 to 1e+200 m are too extreme to compute with"));
}

}  // namespace
}  // namespace plekton::apps::scenario_reader_test
