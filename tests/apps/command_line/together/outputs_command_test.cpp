// SPDX-License-Identifier: GPL-3.0-or-later
// Reactions and lists of contacts that a scenario asks for.
#include "apps/run/history.hpp"
#include "dynamics/output/contact_fields.hpp"
#include "tests/apps/command_line/command_fixture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <sstream>

namespace plekton::apps::outputs_command_test {
namespace {

using testing::HasSubstr;

constexpr std::string_view kReactions = R"(history_interval = "1 ms"
contact_list = true
[[output.reactions]]
kind = "plane"
plane = "floor"
[[output.reactions]]
name = "rim"
kind = "support"
membrane = "sheet"
nodes = "rim"
[[output.reactions]]
kind = "contacts"
membrane = "sheet"
about = [0, 0, "-5 cm"]
[[output.reactions]]
kind = "contacts"
grains = "gravel"
about = [0, 0, "-5 cm"]
)";

/// A table of numbers under its head row.
class Table {
 public:
  explicit Table(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    names_ = parts(line);
    while (std::getline(lines, line)) {
      std::vector<double> row;
      for (const std::string& part : parts(line)) row.push_back(std::stod(part));
      rows.push_back(row);
    }
  }
  double at(const std::vector<double>& row, const std::string& name) const {
    for (std::size_t i = 0; i < names_.size(); ++i)
      if (names_[i] == name) return row.at(i);
    throw std::runtime_error("no column " + name);
  }

  std::vector<std::vector<double>> rows;

 private:
  static std::vector<std::string> parts(const std::string& line) {
    std::vector<std::string> parts;
    std::istringstream in(line);
    for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
    return parts;
  }
  std::vector<std::string> names_;
};

class Outputs : public Command {
 protected:
  void set_output(const std::string& text) {
    test::write_bytes(folder_ / "case.toml", std::string(kScenario) + text);
  }
  Outcome checked(const std::string& text) {
    set_output(text);
    return outcome_of({"check", scenario()});
  }
};

TEST_F(Outputs, OfARunHaveReactionsThatObeyNewtonsThirdLaw) {
  set_output(std::string(kReactions));
  ASSERT_EQ(outcome_of({"run", scenario(), "--out", out()}).exit_code, kDone);

  const Table table(test::bytes_of(folder_ / "out/reactions.csv"));

  ASSERT_EQ(table.rows.size(), 21u);
  double largest = 0.0;
  for (const auto& row : table.rows) {
    for (const char* what : {"force_x (N)", "force_y (N)", "force_z (N)", "moment_x (N m)",
                             "moment_y (N m)", "moment_z (N m)"}) {
      const auto of = [&](const std::string& name) { return table.at(row, name + "." + what); };
      const double size =
          std::abs(of("floor")) + std::abs(of("sheet")) + table.at(row, "sheet.force_z (N)");
      EXPECT_NEAR(of("gravel") + of("sheet") + of("floor"), 0.0, 1e-12 * std::abs(size) + 1e-14);
    }
    largest = std::max(largest, std::abs(table.at(row, "rim.force_z (N)")));
    EXPECT_EQ(table.at(row, "floor.position_z (m)"), -0.05);
    EXPECT_NEAR(table.at(row, "rim.position_x (m)"), 0.0, 1e-15);
  }
  EXPECT_GT(largest, 0.0);
}

TEST_F(Outputs, ListTheContactsOfEveryFrameWithNumbersThatLast) {
  set_output(std::string(kReactions));
  const Outcome outcome = outcome_of({"run", scenario(), "--out", out()});
  ASSERT_EQ(outcome.exit_code, kDone);
  EXPECT_THAT(outcome.out,
              HasSubstr("run.json, energy.csv, reactions.csv, planes.csv, contacts.csv, "
                        "scenario-as-run.toml, checkpoints, and for ParaView "));

  const Table table(test::bytes_of(folder_ / "out/contacts.csv"));

  std::set<std::pair<double, double>> seen;
  for (const auto& row : table.rows) {
    EXPECT_GE(table.at(row, "id"), 1.0);
    EXPECT_TRUE(seen.insert({table.at(row, "time (s)"), table.at(row, "id")}).second);
  }
  EXPECT_EQ(table.rows.back().at(0), table.at(table.rows.back(), "time (s)"));
  const std::string frame = test::bytes_of(folder_ / "out/frames/contacts_00004.vtp");
  const test::VtpReader reader(frame);
  std::size_t at_end = 0;
  for (const auto& row : table.rows) at_end += row[0] == table.rows.back()[0];
  EXPECT_EQ(reader.count("NumberOfLines"), at_end);
  for (const auto& field : dynamics::contact_fields())
    EXPECT_THAT(frame, HasSubstr("Name=\"" + std::string(field.name) + "\""));
}

/// A ball full of air, away from all else.
constexpr std::string_view kAir = R"([[membranes]]
name = "ball"
shape = { kind = "sphere", radius = "2 cm", subdivisions = 2 }
translate = ["30 cm", 0, 0]
thickness = "1 mm"
material = "gravel"
mode = "continuum"
young_modulus = "5 MPa"
areal_mass = "500 g/m2"
[[loads]]
name = "air"
kind = "pressure"
membrane = "ball"
pressure = "1 kPa"
gas = {}
[[output.reactions]]
name = "all of it"
kind = "nodes"
membrane = "ball"
nodes = "all"
)";

TEST_F(Outputs, TellTablesAndMaterialsByNumbersWithNamesInTheReport) {
  set_output("contact_list = true\n[materials.felt]\nyoung_modulus = \"1 MPa\"\n" +
             std::string("friction_angle = \"20 deg\"\n") + std::string(kAir));
  const Outcome outcome =
      outcome_of({"run", scenario(), "--out", out(), "--set", "planes.floor.material=felt", "--set",
                  "membranes.ball.material=felt", "--set", "membranes.ball.translate=[0.3, 0, 0.1]",
                  "--set", "planes.floor.point=[0, 0, \"-5 mm\"]"});
  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;

  const nlohmann::json names = report()["names"];
  const auto number_of = [&](const std::string& kind, const std::string& name) {
    const std::vector<std::string> all = names[kind];
    return static_cast<int>(std::find(all.begin(), all.end(), name) - all.begin());
  };
  const int gravel = number_of("materials", "gravel");
  const int felt = number_of("materials", "felt");
  EXPECT_EQ(gravel + felt, 1);
  EXPECT_EQ(names["grains"], nlohmann::json({"gravel"}));
  EXPECT_EQ(names["planes"], nlohmann::json({"floor"}));

  const test::VtpReader grains(test::bytes_of(folder_ / "out/frames/grains_00000.vtp"));
  EXPECT_EQ(grains.values<std::int32_t>("PointData", "grains"), std::vector<std::int32_t>(20, 0));
  EXPECT_EQ(grains.values<std::int32_t>("PointData", "material"),
            std::vector<std::int32_t>(20, gravel));
  // 200 facets of the sheet, with their sides; then 320 of the ball, which has no beams.
  const test::VtpReader membranes(test::bytes_of(folder_ / "out/frames/membranes_00000.vtp"));
  const auto of_cells = membranes.values<std::int32_t>("CellData", "membrane");
  const auto materials = membranes.values<std::int32_t>("CellData", "material");
  ASSERT_EQ(of_cells.size(), membranes.count("NumberOfLines") + 200U + 320U);
  EXPECT_EQ(of_cells.front(), number_of("membranes", "sheet"));
  EXPECT_EQ(std::count(of_cells.begin(), of_cells.end(), number_of("membranes", "ball")), 320);
  for (std::size_t i = 0; i < of_cells.size(); ++i)
    EXPECT_EQ(materials[i], of_cells[i] == number_of("membranes", "ball") ? felt : gravel);

  const Table table(test::bytes_of(folder_ / "out/contacts.csv"));
  std::set<int> kinds;
  for (const auto& row : table.rows) {
    const int kind = static_cast<int>(table.at(row, "kind_b"));
    kinds.insert(kind);
    const bool is_of_ball = kind != 4 && kind != 0 && table.at(row, "group_b") == 1.0;
    EXPECT_EQ(table.at(row, "group_a"), 0.0);
    EXPECT_EQ(table.at(row, "material_a"), gravel);
    EXPECT_EQ(table.at(row, "material_b"), kind == 4 || is_of_ball ? felt : gravel);
  }
  EXPECT_TRUE(kinds.contains(4));
  EXPECT_GT(kinds.size(), 1U);
}

TEST_F(Outputs, OfMeasuresAreNoneForParaView) {
  set_output(
      "[[output.measures]]\nname = \"low\"\nbox = { min = [-1, -1, -1], max = [1, 1, 1] }\n");
  const Outcome outcome = outcome_of({"run", scenario(), "--out", out()});

  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("energy.csv, planes.csv, measures, scenario-as-run.toml, "
                                     "checkpoints, and for ParaView "));
  EXPECT_THAT(outcome.out, HasSubstr("grains.pvd, membranes.pvd, contacts.pvd\n"));
}

TEST_F(Outputs, OfPressuresHaveTheVolumeThatTheyFollow) {
  set_output(std::string(kAir));
  const Outcome outcome = outcome_of({"run", scenario(), "--out", out()});
  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("reactions.csv, pressures.csv"));

  const Table table(test::bytes_of(folder_ / "out/pressures.csv"));

  const double first = table.at(table.rows.front(), "air.volume (m3)");
  EXPECT_NEAR(first, 4.0 / 3.0 * std::numbers::pi * 8e-6, 0.05 * first);  // of 320 facets
  EXPECT_EQ(table.at(table.rows.front(), "air.pressure (Pa)"), 1000.0);
  for (const auto& row : table.rows) {
    const double pressure = table.at(row, "air.pressure (Pa)") + 101325.0;
    EXPECT_NEAR(pressure * table.at(row, "air.volume (m3)"), 102325.0 * first, 1e-9 * first * 1e5);
  }
}

// Inside the ball, and of the air on it, forces add up to nothing.
TEST_F(Outputs, OfAllNodesOfAFreeBodyHaveItsWeightAndItsPlace) {
  set_output(std::string(kAir));
  ASSERT_EQ(outcome_of({"run", scenario(), "--out", out()}).exit_code, kDone);

  const Table table(test::bytes_of(folder_ / "out/reactions.csv"));

  const double weight = table.at(table.rows[1], "all of it.force_z (N)");
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    const auto& row = table.rows[i];
    EXPECT_NEAR(table.at(row, "all of it.force_z (N)"), weight, 1e-9 * std::abs(weight));
    EXPECT_NEAR(table.at(row, "all of it.force_x (N)"), 0.0, 1e-9 * std::abs(weight));
    EXPECT_NEAR(table.at(row, "all of it.position_x (m)"), 0.3, 1e-4);
    EXPECT_LE(table.at(row, "all of it.position_z (m)"), 1e-6);
  }
  EXPECT_LT(weight, -9.81 * 0.5 * 4.0 * std::numbers::pi * 4e-4 * 0.9);
}

// What holds the rim bears its weight and what the rest of the sheet does to it: until a grain
// touches it they differ by that weight.
TEST_F(Outputs, OfASectionAreWhatTheRestDoesToItsNodes) {
  set_output(R"(history_interval = "1 ms"
[[output.reactions]]
name = "rim"
kind = "support"
membrane = "sheet"
nodes = "rim"
[[output.reactions]]
name = "cut"
kind = "section"
membrane = "sheet"
nodes = "rim"
)");
  ASSERT_EQ(outcome_of({"run", scenario(), "--out", out()}).exit_code, kDone);

  const Table table(test::bytes_of(folder_ / "out/reactions.csv"));

  const auto weight = [&](const auto& row) {
    return table.at(row, "cut.force_z (N)") - table.at(row, "rim.force_z (N)");
  };
  EXPECT_GT(weight(table.rows[1]), 0.0);
  for (std::size_t i = 1; i < 4; ++i) {
    const auto& row = table.rows[i];
    EXPECT_NE(table.at(row, "cut.force_z (N)"), 0.0);
    EXPECT_NEAR(weight(row), weight(table.rows[1]), 1e-9 * weight(row));
  }
}

TEST_F(Outputs, OfASectionNeedNodesAndOthers) {
  EXPECT_THAT(checked(R"([[output.reactions]]
kind = "section"
membrane = "sheet"
nodes = "all"
)")
                  .err,
              HasSubstr("no beam or sheet goes from these nodes of \"sheet\" to others"));
}

TEST_F(Outputs, RefuseANameThatWouldBreakTheHeaderOfATable) {
  const Outcome outcome =
      checked("[[output.reactions]]\nname = \"a\\nb\"\nkind = \"plane\"\nplane = \"floor\"\n");

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr(".name: has a line break or another control character; "
                                     "expected a name on one line"));
}

TEST_F(Outputs, LeaveNoListsOfAnEarlierRunBehind) {
  set_output(std::string(kReactions));
  ASSERT_EQ(outcome_of({"run", scenario(), "--out", out()}).exit_code, kDone);
  set_output("");

  ASSERT_EQ(outcome_of({"run", scenario(), "--out", out(), "--overwrite"}).exit_code, kDone);

  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/reactions.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/contacts.csv"));
}

TEST_F(Outputs, ThatCannotBeAreNamedWithLineAndRemedy) {
  const std::string text = checked(R"([[output.reactions]]
kind = "plane"
plane = "flor"
[[output.reactions]]
kind = "suport"
[[output.reactions]]
kind = "contacts"
membrane = "sheet"
nodes = "rim"
[[output.reactions]]
kind = "plane"
plane = "floor"
[[output.reactions]]
kind = "support"
name = "floor"
membrane = "sheet"
nodes = "rim"
)")
                               .err;

  EXPECT_THAT(text, HasSubstr("case.toml:31:9: output.reactions[0].plane"));
  EXPECT_THAT(text, HasSubstr("there is none called \"flor\"; did you mean \"floor\"?"));
  EXPECT_THAT(text, HasSubstr("\"suport\""));
  EXPECT_THAT(text, HasSubstr("did you mean \"support\"?"));
  EXPECT_THAT(text, HasSubstr("expected kind = \"support\""));
  EXPECT_THAT(text,
              HasSubstr("case.toml:43:8: output.reactions.floor.name: \"floor\" is a reaction "
                        "already"));
  EXPECT_THAT(text, HasSubstr("4 problems"));
}

TEST_F(Outputs, OfSupportsNeedNodesThatAreHeld) {
  EXPECT_THAT(checked(R"([[output.reactions]]
kind = "support"
grains = "gravel"
)")
                  .err,
              HasSubstr("none of these nodes of \"gravel\" is held or moved, so nothing supports "
                        "them; expected nodes of its `hold`"));
  EXPECT_THAT(checked(R"([[output.reactions]]
kind = "support"
membrane = "sheet"
nodes = { min = ["5 m", "5 m", "5 m"], max = ["6 m", "6 m", "6 m"] }
)")
                  .err,
              HasSubstr("\"sheet\" has no node there"));
}

// The servo bears the weight of the lid before it touches anything.
TEST_F(Outputs, OfSupportsTakeARigidBodyThatAServoDrives) {
  set_output(R"([[output.reactions]]
name = "press"
kind = "support"
rigid_body = "press"
[[rigid_bodies]]
name = "press"
shape = { kind = "box", size = [0.1, 0.1, 0.01] }
translate = [2, 0, 1]
thickness = "2 mm"
material = "gravel"
mass = 2
[[loads]]
kind = "servo"
rigid_body = "press"
direction = "-z"
force = "50 N"
speed = "1 mm/s"
)");
  const Outcome outcome = outcome_of({"run", scenario(), "--out", out()});
  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;

  const Table table(test::bytes_of(folder_ / "out/reactions.csv"));

  EXPECT_NEAR(table.at(table.rows.at(1), "press.force_z (N)"), -2.0 * 9.81, 1e-9);
  EXPECT_EQ(table.at(table.rows.at(1), "press.force_x (N)"), 0.0);
}

/// They are held against turning, as nothing turns them.
TEST_F(Outputs, OfSupportsDoNotTakeFreeNodesOfATruss) {
  set_output(R"([[output.reactions]]
kind = "support"
membrane = "rope"
nodes = "x_max"
[[membranes]]
name = "rope"
shape = { kind = "chain", points = [[0, 5, 0], [1, 5, 0]], divisions = 2 }
mode = "truss"
thickness = "20 mm"
material = "gravel"
density = 1000
young_modulus = "1 GPa"
hold = { min = [-0.1, -9, -9], max = [0.1, 9, 9] }
)");
  const Outcome outcome = outcome_of({"check", scenario()});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("none of these nodes of \"rope\" is held or moved"));
}

TEST_F(Outputs, AreListedFromTheTablesThatWriteThem) {
  const std::string text = outcome_of({"list"}).out;

  for (const dynamics::OutputField& field : history_fields())
    EXPECT_THAT(text, HasSubstr("    " + std::string(field.name) + " "));
  for (const dynamics::OutputField& field : dynamics::contact_fields())
    EXPECT_THAT(text, HasSubstr("    " + std::string(field.name) + " "));
  EXPECT_THAT(text, HasSubstr("contact_pressure           Pa"));
}

}  // namespace
}  // namespace plekton::apps::outputs_command_test
