// SPDX-License-Identifier: GPL-3.0-or-later
// Measures of the sample, as the user of the program meets them.
#include "apps/run/measures.hpp"

#include "tests/apps/command_line/command_fixture.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace plekton::apps::measures_test {
namespace {

using testing::HasSubstr;

/// A box of grains without friction at its six walls, which close it and then rest.
constexpr std::string_view kBox = R"([simulation]
gravity = [0, 0, 0]
damping = 0.4
[materials.sand]
density = "2650 kg/m3"
young_modulus = "10 MPa"
friction_angle = "25 deg"
[materials.wall]
young_modulus = "10 MPa"
friction_angle = 0
[[grains]]
name = "sand"
material = "sand"
radius = "4 mm"
porosity = 0.46
box = { min = [0, 0, 0], max = ["50 mm", "50 mm", "60 mm"] }
placement = "packed"
[[planes]]
name = "left"
point = [0, 0, 0]
normal = [1, 0, 0]
material = "wall"
[[planes]]
name = "right"
point = ["50 mm", 0, 0]
normal = [-1, 0, 0]
material = "wall"
[[planes]]
name = "front"
point = [0, 0, 0]
normal = [0, 1, 0]
material = "wall"
[[planes]]
name = "back"
point = [0, "50 mm", 0]
normal = [0, -1, 0]
material = "wall"
[[planes]]
name = "floor"
point = [0, 0, 0]
material = "wall"
[[planes]]
name = "lid"
point = [0, 0, "60 mm"]
normal = [0, 0, -1]
material = "wall"
[[loads]]
name = "press"
kind = "servo"
plane = "lid"
pressure = "20 kPa"
between = ["left", "right", "front", "back"]
speed = "0.3 m/s"
[output]
interval = "50 ms"
history_interval = "5 ms"
[[output.reactions]]
kind = "plane"
plane = "lid"
[[output.reactions]]
kind = "plane"
plane = "left"
[[output.measures]]
name = "whole"
between = ["left", "right", "front", "back", "floor", "lid"]
box = { min = [-1, -1, -1], max = [1, 1, 1] }
[[output.measures]]
name = "middle"
heights = { bottom = "20 mm", top = "35 mm" }
[[stages]]
name = "press"
end = { servo = { load = "press", tolerance = "1 %" }, after = "5 ms" }
max_duration = "200 ms"
[[stages]]
name = "rest"
end = { unbalanced_force = 1e-4 }
max_duration = "300 ms"
[[stages.output.measures]]
name = "later"
sphere = { centre = ["25 mm", "25 mm", "30 mm"], radius = "20 mm" }
)";

/// A CSV file: what stands in a column, row by row.
class Csv {
 public:
  explicit Csv(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    head_ = cells(line);
    while (std::getline(lines, line)) rows_.push_back(cells(line));
  }
  std::vector<double> column(const std::string& name) const {
    const auto found = std::find_if(head_.begin(), head_.end(), [&](const std::string& cell) {
      return cell == name || cell.starts_with(name + " (");
    });
    EXPECT_NE(found, head_.end()) << name;
    std::vector<double> values;
    for (const auto& row : rows_)
      values.push_back(std::stod(row[static_cast<std::size_t>(found - head_.begin())]));
    return values;
  }
  double last(const std::string& name) const { return column(name).back(); }

 private:
  static std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    return cells;
  }
  std::vector<std::string> head_;
  std::vector<std::vector<std::string>> rows_;
};

class Measured : public Command {
 protected:
  Measured() { test::write_bytes(folder_ / "box.toml", std::string(kBox)); }
  std::string box() const { return (folder_ / "box.toml").string(); }
  Csv csv(const std::string& folder, const std::string& file) const {
    return Csv(test::bytes_of(folder_ / folder / file));
  }
  std::string problem(const std::string& from, const std::string& to) const {
    std::string text(kBox);
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    test::write_bytes(folder_ / "bad.toml", text.replace(place, from.size(), to));
    const Outcome outcome = outcome_of({"check", (folder_ / "bad.toml").string()});
    EXPECT_EQ(outcome.exit_code, 1);
    return outcome.err;
  }
};

// Of the closed box at rest the stress is that of its walls to rounding of the balance; wall
// branches end where forces act, half an overlap (below 1e-3 of a radius of 4 mm) from the planes.
TEST_F(Measured, StressIsThatOfTheWallsAndPorosityWhatWasAskedFor) {
  const Outcome outcome = outcome_of({"run", box(), "--out", out(), "--quiet"});
  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;

  const Csv whole = csv("out", "measures/whole.csv");
  const Csv reactions = csv("out", "reactions.csv");
  EXPECT_NEAR(whole.column("porosity").front(), 0.46, 0.002);
  EXPECT_NEAR(whole.column("volume").front(), 0.05 * 0.05 * 0.06, 1e-12);
  const double volume = whole.last("volume");
  const double height = volume / (0.05 * 0.05);
  EXPECT_LT(height, 0.06);
  const double lid = std::abs(reactions.last("lid.force_z")) / (0.05 * 0.05);
  const double left = std::abs(reactions.last("left.force_x")) / (0.05 * height);
  EXPECT_NEAR(lid, 20e3, 0.02 * 20e3);
  EXPECT_NEAR(-whole.last("stress_zz"), lid, 2e-3 * lid);
  EXPECT_NEAR(-whole.last("stress_xx"), left, 2e-3 * lid);
  EXPECT_GT(whole.last("coordination_number_without_rattlers"), 3.5);
  EXPECT_GE(whole.last("coordination_number_without_rattlers"), whole.last("coordination_number"));
  // Forces are in balance: so are moments, and the stress is symmetric.
  EXPECT_LT(whole.last("stress_asymmetry"), 5e-3 * lid);
}

/// A sample in a cell of a floor, a lid and a smooth side, which all press with 20 kPa.
constexpr std::string_view kCell = R"([simulation]
gravity = [0, 0, 0]
damping = 0.4
[materials.sand]
density = "2650 kg/m3"
young_modulus = "10 MPa"
friction_angle = "25 deg"
[materials.wall]
young_modulus = "10 MPa"
friction_angle = 0
[[grains]]
name = "sand"
material = "sand"
radius = "4 mm"
porosity = 0.45
cylinder = { from = [0, 0, 0], to = [0, 0, "60 mm"], radius = "30 mm" }
placement = "packed"
[[planes]]
name = "side"
kind = "cylinder"
point = [0, 0, 0]
radius = "30 mm"
material = "wall"
[[planes]]
name = "floor"
point = [0, 0, 0]
material = "wall"
[[planes]]
name = "lid"
point = [0, 0, "60 mm"]
normal = [0, 0, -1]
material = "wall"
[[loads]]
name = "lid"
kind = "servo"
plane = "lid"
force = "56.5 N"
speed = "0.1 m/s"
[[loads]]
name = "side"
kind = "servo"
plane = "side"
pressure = "20 kPa"
between = ["floor", "lid"]
speed = "0.1 m/s"
[output]
interval = "50 ms"
history_interval = "5 ms"
[[output.measures]]
name = "whole"
between = ["side", "floor", "lid"]
cylinder = { from = [0, 0, -1], to = [0, 0, 1], radius = 1 }
[[stages]]
name = "press"
end = { servo = { load = "side", tolerance = "1 %" }, after = "5 ms" }
max_duration = "200 ms"
[[stages]]
name = "rest"
end = { unbalanced_force = 1e-4 }
max_duration = "400 ms"
)";

// The stress across the axis is what the side presses with, times its radius where forces act, half
// an overlap (some 1e-3 of a radius of 4 mm) beyond the wall. Walls go on for a drift after forces.
TEST_F(Measured, StressInACellIsThatOfItsSideAndEnds) {
  test::write_bytes(folder_ / "cell.toml", std::string(kCell));
  const Outcome outcome =
      outcome_of({"run", (folder_ / "cell.toml").string(), "--out", out(), "--quiet"});
  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;

  const Csv whole = csv("out", "measures/whole.csv");
  const Csv planes = csv("out", "planes.csv");
  const double radius = planes.last("side.radius");
  const double height = planes.last("lid.point_z");
  const double area = std::acos(-1.0) * radius * radius;
  EXPECT_LT(radius, 0.03);
  EXPECT_NEAR(whole.last("volume"), area * height, 1e-6 * area * height);
  EXPECT_NEAR(-0.5 * (whole.last("stress_xx") + whole.last("stress_yy")), 20e3, 0.005 * 20e3);
  EXPECT_NEAR(-whole.last("stress_zz"), 56.5 / area, 0.005 * 20e3);
  const double wall = 2.0 * std::acos(-1.0) * radius * height;
  EXPECT_NEAR(planes.last("side.pressing"), 20e3 * wall, 0.005 * 20e3 * wall);
  EXPECT_NEAR(planes.last("lid.pressing"), 56.5, 0.005 * 56.5);
}

/// A grain that rests in a cell that is moved past the place where the region was.
TEST_F(Measured, GoesWithAContainerThatMoves) {
  test::write_bytes(folder_ / "moved.toml", R"([simulation]
gravity = [0, 0, 0]
duration = "10 ms"
[materials.sand]
density = "2650 kg/m3"
young_modulus = "10 MPa"
friction_angle = 0
[[grains]]
name = "sand"
material = "sand"
radius = "4 mm"
velocity = ["4 m/s", 0, 0]
centres = [[0, 0, "30 mm"]]
[[planes]]
name = "side"
kind = "cylinder"
point = [0, 0, "5 mm"]
radius = "10 mm"
velocity = ["4 m/s", 0, 0]
material = "sand"
[output]
interval = "10 ms"
history_interval = "1 ms"
[[output.measures]]
name = "inside"
between = ["side"]
cylinder = { from = [0, 0, 0], to = [0, 0, "60 mm"], radius = 1 }
)");
  const Outcome outcome =
      outcome_of({"run", (folder_ / "moved.toml").string(), "--out", out(), "--quiet"});
  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;

  EXPECT_GT(csv("out", "planes.csv").last("side.point_x"), 0.03);
  EXPECT_EQ(csv("out", "measures/inside.csv").last("grains"), 1.0);
}

TEST_F(Measured, HasOneRowForEachRowOfTheEnergiesFromWhereItBegins) {
  ASSERT_EQ(outcome_of({"run", box(), "--out", out(), "--quiet"}).exit_code, kDone);

  const std::vector<double> energies = csv("out", "energy.csv").column("time");
  EXPECT_EQ(csv("out", "measures/whole.csv").column("time"), energies);
  EXPECT_EQ(csv("out", "measures/middle.csv").column("time"), energies);
  const std::vector<double> later = csv("out", "measures/later.csv").column("time");
  ASSERT_LT(later.size(), energies.size());
  EXPECT_TRUE(std::equal(later.rbegin(), later.rend(), energies.rbegin()));
}

TEST_F(Measured, IsTheSameForAnyThreadsAndStageByStage) {
  const std::string other = (folder_ / "other").string();
  const std::string parts = (folder_ / "parts").string();
  ASSERT_EQ(outcome_of({"run", box(), "--out", out(), "--quiet"}).exit_code, kDone);
  ASSERT_EQ(outcome_of({"run", box(), "--out", other, "--quiet", "--threads", "3"}).exit_code,
            kDone);
  ASSERT_EQ(outcome_of({"run", box(), "--out", parts, "--quiet", "--until", "press"}).exit_code,
            kDone);
  ASSERT_EQ(outcome_of({"run", "--resume", parts, "--quiet", "--threads", "2"}).exit_code, kDone);

  for (const char* const name : {"whole", "middle", "later"}) {
    const std::string file = std::string("measures/") + name + ".csv";
    const std::string bytes = test::bytes_of(folder_ / "out" / file);
    EXPECT_GT(bytes.size(), 1000U);
    EXPECT_EQ(test::bytes_of(folder_ / "other" / file), bytes) << name;
    EXPECT_EQ(test::bytes_of(folder_ / "parts" / file), bytes) << name;
  }
}

TEST_F(Measured, OfAnEarlierRunIsGoneWhereTheFolderIsOverwritten) {
  ASSERT_EQ(outcome_of({"run", box(), "--out", out(), "--quiet", "--until", "press"}).exit_code,
            kDone);
  std::filesystem::copy(folder_ / "out/measures/whole.csv", folder_ / "out/measures/old.csv");

  EXPECT_EQ(outcome_of({"run", scenario(), "--out", out(), "--quiet"}).exit_code, 1);
  ASSERT_EQ(outcome_of({"run", scenario(), "--out", out(), "--quiet", "--overwrite"}).exit_code,
            kDone);

  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/measures"));
}

// Every CSV file in the folder was removed.
TEST_F(Measured, LeavesFilesBesideItsOwnThatNoRunWrote) {
  ASSERT_EQ(outcome_of({"run", box(), "--out", out(), "--quiet", "--until", "press"}).exit_code,
            kDone);
  test::write_bytes(folder_ / "out/measures/mine.csv", "time (s),force (N)\n0,1\n");

  ASSERT_EQ(outcome_of({"run", scenario(), "--out", out(), "--quiet", "--overwrite"}).exit_code,
            kDone);

  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/measures/whole.csv"));
  EXPECT_EQ(test::bytes_of(folder_ / "out/measures/mine.csv"), "time (s),force (N)\n0,1\n");
}

TEST_F(Measured, TakesNoFolderOfOtherTablesForResults) {
  std::filesystem::create_directories(folder_ / "out/measures");
  test::write_bytes(folder_ / "out/measures/mine.csv", "time (s),force (N)\n0,1\n");

  const Outcome outcome = outcome_of({"run", scenario(), "--out", out()});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("measures")));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/measures/mine.csv"));
}

TEST_F(Measured, RefusesToReplaceATableOfSomebodyElse) {
  std::filesystem::create_directories(folder_ / "out/measures");
  test::write_bytes(folder_ / "out/measures/whole.csv", "mine");

  const Outcome outcome = outcome_of({"run", box(), "--out", out(), "--quiet", "--overwrite"});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("whole.csv: is there already and no measure of plekton run"));
  EXPECT_EQ(test::bytes_of(folder_ / "out/measures/whole.csv"), "mine");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/energy.csv"));
}

TEST_F(Measured, RefusesWhatItCannotMeasure) {
  EXPECT_THAT(problem("name = \"whole\"", "name = \"a/b\""),
              HasSubstr("names a file, measures/NAME.csv; expected letters"));
  EXPECT_THAT(problem("name = \"middle\"", "name = \"whole\""),
              HasSubstr("\"whole\" is a measure already"));
  EXPECT_THAT(problem("heights = { bottom = \"20 mm\", top = \"35 mm\" }",
                      "heights = { bottom = \"35 mm\", top = \"20 mm\" }"),
              HasSubstr("got 0.02 m, not above 0.035 m of bottom"));
  EXPECT_THAT(problem("heights = {", "box = { min = [0, 0, 0], max = [1, 1, 1] }\nheights = {"),
              HasSubstr("got 2 of \"sphere\", \"box\", \"cylinder\", \"heights\""));
  EXPECT_THAT(problem("heights = { bottom = \"20 mm\", top = \"35 mm\" }",
                      "between = [\"lid\"]\nsphere = { centre = [0, 0, 0], radius = 1 }"),
              HasSubstr("a sphere cannot be cut"));
  EXPECT_THAT(problem("\"floor\", \"lid\"]\nbox", "\"floor\", \"led\"]\nbox"),
              HasSubstr("there is none called \"led\"; did you mean"));
  EXPECT_THAT(problem("heights = { bottom = \"20 mm\", top = \"35 mm\" }",
                      "cylinder = { from = [0, 0, 0], to = [0, 0, 0], radius = 1 }"),
              HasSubstr("is 0 m from `from`"));
}

TEST_F(Measured, RefusesPackingsThatCannotBe) {
  EXPECT_THAT(problem("porosity = 0.46", "porosity = 0.3"),
              HasSubstr("grains.sand.porosity: got 0.3; expected at least 0.35 of equal grains"));
  EXPECT_THAT(problem("radius = \"4 mm\"\nporosity = 0.46",
                      "sieves = [{ sieve = \"7 mm\", passing = 0 }, { sieve = \"9 mm\", passing = "
                      "1 }]\nporosity = 0.25"),
              HasSubstr("packed without friction they jam at a porosity of 0."));
  EXPECT_THAT(problem("porosity = 0.46", "porosity = 1.2"), HasSubstr("above 0 and below 1"));
  EXPECT_THAT(problem("porosity = 0.46", "porosity = 0.46\ncount = 9"),
              HasSubstr("got 2 of \"count\", \"mass\", \"volume\", \"porosity\""));
  EXPECT_THAT(problem("porosity = 0.46", "porosity = 0.46\nstress = \"1 kPa\""),
              HasSubstr("without friction one follows from the other"));
  EXPECT_THAT(problem("placement = \"packed\"", "stress = \"1 kPa\""),
              HasSubstr("goes with placement = \"packed\""));
  EXPECT_THAT(problem("box = { min = [0, 0, 0], max = [\"50 mm\", \"50 mm\", \"60 mm\"] }",
                      "inside = \"bag\""),
              HasSubstr("there is no membrane or rigid body called \"bag\""));
  EXPECT_THAT(problem("box = { min = [0, 0, 0], max = [\"50 mm\", \"50 mm\", \"60 mm\"] }", ""),
              HasSubstr("or a cylinder, a closed membrane to be inside of"));
  EXPECT_THAT(problem("placement = \"packed\"", "placement = \"pack\""), HasSubstr("packed"));
}

}  // namespace
}  // namespace plekton::apps::measures_test
