// SPDX-License-Identifier: GPL-3.0-or-later
// How scenes begin, as the user of the program hears of it: boxes, bonds, and who is in whom.
#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <string>

namespace plekton::apps::start_of_scenes_test {
namespace {

using testing::HasSubstr;
using testing::Not;

class StartOfScenes : public testing::Test {
 protected:
  /// @param bodies  tables after those of two materials, stone and clay
  void write(const std::string& bodies) const {
    test::write_bytes(folder_ / "case.toml", R"([simulation]
duration = "1 us"
[materials.stone]
density = "2650 kg/m3"
young_modulus = "50 MPa"
friction_angle = "30 deg"
[materials.clay]
density = "2000 kg/m3"
young_modulus = "5 MPa"
friction_angle = "20 deg"
)" + bodies);
  }
  Outcome check(const std::string& bodies) const {
    write(bodies);
    return outcome_of({"check", (folder_ / "case.toml").string()});
  }
  Outcome run(const std::string& bodies) const {
    write(bodies);
    return outcome_of(
        {"run", (folder_ / "case.toml").string(), "--out", (folder_ / "out").string()});
  }
  /// Of a scene that both commands refuse, with nothing written.
  std::string refusal_of(const std::string& bodies) const {
    const Outcome checked = check(bodies);
    const Outcome ran = run(bodies);
    EXPECT_EQ(checked.exit_code, kFailed);
    EXPECT_EQ(ran.exit_code, kFailed);
    EXPECT_EQ(checked.err, ran.err);
    EXPECT_THAT(checked.out, Not(HasSubstr("no problems")));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
    return ran.err;
  }

  test::TemporaryFolder folder_;
};

/// Grains of 10 mm radius, of stone.
std::string grains(const std::string& name, const std::string& centres) {
  return "[[grains]]\nname = \"" + name +
         "\"\nmaterial = \"stone\"\nradius = \"10 mm\"\ncentres = [" + centres + "]\n";
}

/// A flat sheet of 0.2 m x 0.2 m and 4 mm thickness, of clay, in z = 0 before it is placed.
std::string sheet(const std::string& name, const std::string& placement) {
  return "[[membranes]]\nname = \"" + name +
         "\"\nmaterial = \"clay\"\nthickness = \"4 mm\"\nyoung_modulus = \"1 MPa\"\n"
         "density = \"1000 kg/m3\"\n"
         "shape = { kind = \"sheet\", width = 0.2, length = 0.2, cells = [4, 4] }\n" +
         placement + "\n";
}

constexpr const char* kFloor =
    "[[planes]]\nname = \"floor\"\npoint = [0, 0, 0]\nmaterial = \"clay\"\n";

TEST_F(StartOfScenes, AreListedWithTheBoxesOfTheirBodies) {
  const Outcome outcome = check(sheet("m", "translate = [1, 0, 0.5]") +
                                grains("g", "[0, 0, 0.1], [0, 0.3, 0.2]") + kFloor);

  EXPECT_EQ(outcome.exit_code, kDone);
  EXPECT_THAT(outcome.out,
              HasSubstr("box of membranes.m: (0.898, -0.102, 0.498) to (1.102, 0.102, 0.502) m\n"));
  EXPECT_THAT(outcome.out,
              HasSubstr("box of grains.g: (-0.01, -0.01, 0.09) to (0.01, 0.31, 0.21) m\n"));
  EXPECT_THAT(outcome.out,
              HasSubstr("box of everything: (-0.01, -0.102, 0.09) to (1.102, 0.31, 0.502) m\n"));
  EXPECT_THAT(outcome.out, HasSubstr("overlaps at the start: none\n"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("warning")));
}

TEST_F(StartOfScenes, AreListedWithWhoOverlapsWhomHowDeepAndWhere) {
  // 18 mm apart: 2 mm of 10. On the floor: 0.4 mm of 10. On the sheet, which begins 2 mm above its
  // middle: 0.08 mm of the grain's 10, as in the run.
  const Outcome outcome =
      check(grains("a", "[0, 0, 0.5], [0, 0, 0.7]") + grains("b", "[0.018, 0, 0.5]") +
            grains("c", "[0.5, 0, 0.0096]") + grains("d", "[2, 0, 0.51192]") +
            sheet("m", "translate = [2, 0, 0.5]") + kFloor);

  EXPECT_EQ(outcome.exit_code, kDone);
  EXPECT_THAT(outcome.out, HasSubstr("overlaps at the start of grains.a with grains.b: 1\n"
                                     "  2 mm (20 % of the radius) of grain 0 and grain 0 at "
                                     "(0.009, 0, 0.5) m\n"));
  EXPECT_THAT(outcome.out, HasSubstr("of grains.c with planes.floor: 1\n"
                                     "  0.4 mm (4 % of the radius) of grain 0 at (0.5, 0, "));
  EXPECT_THAT(outcome.out, HasSubstr("of grains.d with membranes.m: 1\n"
                                     "  0.08 mm (0.8 % of the radius) of grain 0 at (2, 0, "));
  EXPECT_THAT(outcome.out, HasSubstr("warning: 1 contact begins with an overlap above 5 %"));
  EXPECT_THAT(outcome.out, HasSubstr("the deepest grains.a with grains.b by 2 mm"));
}

/// Centres two radii apart to rounding, which is either side of touching.
TEST_F(StartOfScenes, DoNotCountRoundingAsAnOverlap) {
  const Outcome outcome =
      check(grains("g",
                   "[0, 0, 0.1], [0.02, 0, 0.1], [0.04, 0, 0.1], [0.06, 0, 0.1], "
                   "[0.08, 0, 0.1], [0.1, 0, 0.1], [0.12, 0, 0.1], [0.14, 0, 0.1]"));

  EXPECT_THAT(outcome.out, HasSubstr("overlaps at the start: none\n"));
}

TEST_F(StartOfScenes, ListTheDeepestFewOfManyOverlaps) {
  std::string centres;
  for (int i = 0; i < 9; ++i)
    centres += (i == 0 ? "[" : ", [") + std::to_string(i) + ", 0, 0.009" + std::to_string(i) + "]";
  const Outcome outcome = check(grains("g", centres) + kFloor);

  EXPECT_THAT(outcome.out, HasSubstr("of grains.g with planes.floor: 9, the deepest\n"
                                     "  1 mm (10 % of the radius) of grain 0 at (0, 0, "));
  EXPECT_THAT(outcome.out, HasSubstr("of grain 4 at (4, 0, "));
  EXPECT_THAT(outcome.out, Not(HasSubstr("of grain 5 at (5, 0, ")));
}

TEST_F(StartOfScenes, AreRefusedWhereGrainsAreInEachOtherByMoreThanTheirRadii) {
  const std::string error = refusal_of(grains("b", "[0.3, 0, 0.01], [0.305, 0, 0.01]"));

  EXPECT_THAT(error, HasSubstr("case.toml:11:1: grains.b: begins in grains.b at 1 place, deeper "
                               "than both radii, by 15 mm (150 % of the radius) of grain 0 and "
                               "grain 1 at (0.3025, 0, 0.01) m; move them apart"));
}

TEST_F(StartOfScenes, AreRefusedWhereGrainsBeginBehindAPlane) {
  const std::string error =
      refusal_of(grains("g", "[0, 0, -0.05], [1, 0, -0.001], [2, 0, 0.001]") + kFloor);

  EXPECT_THAT(error, HasSubstr("case.toml:11:1: grains.g: 2 of its grains begin behind "
                               "planes.floor, the deepest by 60 mm (600 % of the radius) of grain "
                               "0 at (0, 0, "));
  EXPECT_THAT(error, HasSubstr("move them to the side that the normal of the plane points to"));
}

TEST_F(StartOfScenes, AreRefusedWhereGrainsBeginOutsideOfAContainer) {
  const std::string error = refusal_of(
      grains("g", "[0, 0, 0], [0.06, 0, 0]") +
      "[[planes]]\nname = \"cell\"\nkind = \"cylinder\"\npoint = [0, 0, 0]\nradius = \"5 cm\"\n"
      "material = \"stone\"\n");

  EXPECT_THAT(error, HasSubstr("grains.g: 1 of its grains begins behind planes.cell, by 20 mm"));
  EXPECT_THAT(error, HasSubstr("; move them inside, or move or widen it"));
}

TEST_F(StartOfScenes, AreRefusedWhereNodesOfMembranesBeginBehindAPlane) {
  const std::string error = refusal_of(sheet("m", "translate = [0, 0, -0.1]") + kFloor);

  EXPECT_THAT(error, HasSubstr("membranes.m: 25 of its nodes begin behind planes.floor, the "
                               "deepest by 102 mm"));
}

/// Planes do not push on nodes that are held: a sheet may be clamped in a wall.
TEST_F(StartOfScenes, MayHaveHeldNodesBehindAPlane) {
  const Outcome outcome = check(sheet("m", "translate = [0, 0, -0.1]\nhold = \"all\"") +
                                grains("g", "[0, 0, 1]") + kFloor);

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
}

/// Two sheets that cross at a right angle along y.
TEST_F(StartOfScenes, AreRefusedWhereMembranesCross) {
  const std::string error =
      refusal_of(sheet("flat", "") + sheet("upright",
                                           "rotate = { axis = [0, 1, 0], angle = \"90 deg\" }\n"
                                           "translate = [0.01, 0.007, 0]"));

  EXPECT_THAT(error, HasSubstr("membranes.flat: begins in membranes.upright at "));
  EXPECT_THAT(error, HasSubstr("deeper than both radii, "));
  EXPECT_THAT(error, HasSubstr("by 4 mm (200 % of the radius) at (0.01, "));
}

TEST_F(StartOfScenes, MayHaveMembranesThatOverlapByLessWithAWarning) {
  const Outcome outcome = check(sheet("low", "") + sheet("high", "translate = [0, 0, \"3 mm\"]"));

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("overlaps at the start of membranes.low with membranes.high: "));
  EXPECT_THAT(outcome.out, HasSubstr("  1 mm (50 % of the radius) at ("));
  EXPECT_THAT(outcome.out, HasSubstr("1 contact begins with an overlap above 5 % of the radius"));
}

/// A rope laid in a figure of eight: what its own parts do is told, and may be meant.
TEST_F(StartOfScenes, MayHaveAMembraneInItselfWithAWarning) {
  const Outcome outcome = check(
      "[[membranes]]\nname = \"rope\"\nmaterial = \"clay\"\nthickness = \"4 mm\"\n"
      "young_modulus = \"1 MPa\"\ndensity = \"1000 kg/m3\"\n"
      "shape = { kind = \"chain\", points = [[0, 0, 0], [0.3, 0.3, 0], [0.3, 0, 0], [0, 0.3, 0]], "
      "divisions = 5 }\n");

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("overlaps at the start of membranes.rope with membranes.rope: "));
  EXPECT_THAT(outcome.out, HasSubstr("warning: "));
}

TEST_F(StartOfScenes, AreRefusedWithAllThatIsWrongTogether) {
  const std::string error = refusal_of(grains("a", "[0, 0, -0.05]") +
                                       grains("b", "[0.3, 0, 0.1], [0.305, 0, 0.1]") + kFloor);

  EXPECT_THAT(error, HasSubstr("plekton: 2 problems\n"));
  EXPECT_THAT(error, HasSubstr("grains.a: 1 of its grains begins behind planes.floor, by 60 mm"));
  EXPECT_THAT(error, HasSubstr("grains.b: begins in grains.b"));
}

/// The law that sticks, between stone and stone.
std::string glue(const std::string& more) {
  return "[[contacts]]\nbetween = \"stone\"\nand = \"stone\"\nlaw = \"cohesive_frictional\"\n" +
         more + "\n";
}

TEST_F(StartOfScenes, SayHowManyBondsTheyBeginWith) {
  // Three in a row that overlap by 0.1 mm, and one apart.
  const std::string row =
      grains("g", "[0, 0, 0.1], [0.0199, 0, 0.1], [0.0398, 0, 0.1], [0.1, 0, 0.1]");

  const Outcome outcome = check(glue("tensile_strength = \"1 MPa\"\nbonds = \"start\"") + row);

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("bonds of stone with stone: 2 at the start\n"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("warning")));
}

TEST_F(StartOfScenes, WarnOfABondRuleThatGluesNothing) {
  const std::string apart = grains("g", "[0, 0, 0.1], [0.1, 0, 0.1]");

  const Outcome none = check(glue("tensile_strength = \"1 MPa\"\nbonds = \"start\"") + apart);
  const Outcome weak = check(glue("") + apart);
  const Outcome later = check(glue("tensile_strength = \"1 MPa\"") + apart);

  EXPECT_THAT(none.out, HasSubstr("bonds of stone with stone: 0 at the start\n"));
  EXPECT_THAT(none.out, HasSubstr("case.toml:11:1: contacts[0], stone with stone: bonds = "
                                  "\"start\" glues nothing: no such bodies touch at the start"));
  EXPECT_THAT(weak.out, HasSubstr("its bonds have no strength and glue nothing"));
  EXPECT_THAT(later.out, Not(HasSubstr("warning")));
}

TEST_F(StartOfScenes, WarnOfALimitOfRollingWithoutItsSpring) {
  const std::string apart = grains("g", "[0, 0, 0.1], [0.1, 0, 0.1]");
  const std::string contacts = "[[contacts]]\nbetween = \"stone\"\nand = \"stone\"\n";

  const Outcome alone = check(contacts + "rolling_limit = 0.1\n" + apart);
  const Outcome other = check(contacts + "rolling_stiffness = 1\ntwisting_limit = 0.1\n" + apart);
  const Outcome both = check(contacts + "rolling_stiffness = 1\nrolling_limit = 0.1\n" + apart);

  EXPECT_THAT(alone.out, HasSubstr("case.toml:11:1: contacts[0], stone with stone: rolling_limit "
                                   "does nothing without rolling_stiffness; give one, such as 1"));
  EXPECT_THAT(other.out, HasSubstr("twisting_limit does nothing without twisting_stiffness"));
  EXPECT_THAT(both.out, Not(HasSubstr("warning")));
}

TEST_F(StartOfScenes, CountBondsBetweenMembranes) {
  // Two bars crossing at a right angle, 0.1 mm deep: one contact, one bond.
  const auto bar = [](const std::string& name, const std::string& points) {
    return "[[membranes]]\nname = \"" + name +
           "\"\nmaterial = \"stone\"\nthickness = \"4 mm\"\nyoung_modulus = \"1 MPa\"\n"
           "density = \"1000 kg/m3\"\nshape = { kind = \"chain\", points = " +
           points + " }\n";
  };
  const Outcome outcome = check(glue("tensile_strength = \"1 MPa\"\nbonds = \"start\"") +
                                bar("along", "[[-0.1, 0, 0], [0.1, 0, 0]]") +
                                bar("across", "[[0, -0.1, 0.0039], [0, 0.1, 0.0039]]"));

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("bonds of stone with stone: 1 at the start\n"));
  EXPECT_THAT(outcome.out,
              HasSubstr("overlaps at the start of membranes.along with membranes.across: 1\n"
                        "  0.1 mm (5 % of the radius) at (0, 0, "));
}

TEST_F(StartOfScenes, WriteTheWarningsOfTheirStartIntoTheReportOfTheRun) {
  const Outcome outcome = run(grains("g", "[0, 0, 0.1], [0.018, 0, 0.1]"));

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(test::bytes_of(folder_ / "out/run.json"),
              HasSubstr("1 contact begins with an overlap above 5 %"));
}

}  // namespace
}  // namespace plekton::apps::start_of_scenes_test
