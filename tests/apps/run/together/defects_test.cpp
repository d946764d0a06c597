// SPDX-License-Identifier: GPL-3.0-or-later
// Scenarios that once failed, as they were found (tests/apps/run/defects): by the program as it is
// called, for as long as it takes to pass what went wrong.
#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/support/parameter_name.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace plekton::apps::defects_test {
namespace {

using testing::HasSubstr;

/// What is asked of the energy balance, over what went through.
constexpr double kClosed = 1e-3;

std::string file_of(const std::string& name) {
  return std::string(PLEKTON_SOURCE_DIR) + "/tests/apps/run/defects/" + name + ".toml";
}

/// Rows of a CSV file by the names of its columns.
using Row = std::map<std::string, double>;

class Defect {
 public:
  Defect(const std::string& name, const std::vector<std::string>& settings) {
    std::vector<std::string> arguments = {
        "run", file_of(name), "--quiet", "--threads", "1", "--out", (folder_ / "out").string()};
    for (const std::string& setting : settings)
      arguments.insert(arguments.end(), {"--set", setting});
    outcome_ = outcome_of(arguments);
  }

  const Outcome& outcome() const noexcept { return outcome_; }
  nlohmann::json report() const {
    return nlohmann::json::parse(test::bytes_of(folder_ / "out/run.json"));
  }
  double closure() const { return report().at("energy_closure").get<double>(); }
  std::vector<Row> energy() const { return rows("energy.csv"); }
  std::vector<Row> rows(const std::string& file) const {
    std::istringstream lines(test::bytes_of(folder_ / "out" / file));
    std::vector<std::string> names;
    std::vector<Row> rows;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream cells(line);
      std::size_t column = 0;
      const bool is_head = names.empty();
      if (!is_head) rows.emplace_back();
      for (std::string cell; std::getline(cells, cell, ','); ++column) {
        if (is_head) {
          names.push_back(cell);
        } else {
          rows.back()[names.at(column)] = std::stod(cell);
        }
      }
    }
    return rows;
  }

 private:
  test::TemporaryFolder folder_;
  Outcome outcome_;
};

struct Case {
  const char* name;
  std::vector<std::string> settings;
};

void PrintTo(const Case& of, std::ostream* out) {
  *out << of.name;
  for (const std::string& setting : of.settings) *out << ' ' << setting;
}

class DefectsOfRuns : public testing::TestWithParam<Case> {};

TEST_P(DefectsOfRuns, EndWithTheirEnergyClosed) {
  const Defect defect(GetParam().name, GetParam().settings);

  ASSERT_EQ(defect.outcome().exit_code, 0) << defect.outcome().err;
  EXPECT_EQ(defect.report().at("status").get<std::string>(), "finished");
  EXPECT_GT(defect.report().at("largest_overlap_ratio").get<double>(), 0.0);
  EXPECT_LT(defect.closure(), kClosed);
}

// The servos touch at other moments of a step where the lid begins elsewhere.
INSTANTIATE_TEST_SUITE_P(All, DefectsOfRuns,
                         testing::Values(Case{"boulder", {"simulation.duration=5e-3"}},
                                         Case{"glue", {"simulation.duration=2e-4"}},
                                         Case{"fold", {}}, Case{"fold_full_1399", {}},
                                         Case{"spike_21146", {}}, Case{"servo0", {}},
                                         Case{"servo0", {"planes.lid.point=[0, 0, 0.05003]"}},
                                         Case{"servo0", {"planes.lid.point=[0, 0, 0.05011]"}},
                                         Case{"servo0", {"planes.lid.point=[0, 0, 0.05017]"}},
                                         Case{"servo_95", {"simulation.duration=0.45"}},
                                         Case{"servo_1572", {"simulation.duration=1"}},
                                         Case{"glued_in_a_groove", {}},
                                         Case{"flat_net", {"simulation.time_step=5e-6"}},
                                         Case{"cylinder_on_net", {"simulation.duration=0.01"}},
                                         Case{"laminate", {"simulation.time_step=5e-6"}}),
                         test::name_of_parameter);

// 26 kg at 4 m/s press a net in by four times the thickness of its wires: the contact is twice or
// half as stiff from one step to the next, and one look in 64 steps is not one at the stiffest of
// them. 30 J were made of 209 J (37 kJ once); a certificate is green below 1 %. What is seen is
// 0.03 %, and 0.08 % at most with other densities from 300 to 800 kg/m³.
TEST(Defects, ABoulderPressedDeepIntoANetMakesNoEnergy) {
  const Defect defect("boulder",
                      {"simulation.duration=0.03", "materials.steel.young_modulus=1e8",
                       "membranes.net.shape.apertures=[12, 12]", "materials.steel.density=400"});

  ASSERT_EQ(defect.outcome().exit_code, 0) << defect.outcome().err;
  EXPECT_GT(defect.report().at("largest_overlap_ratio").get<double>(), 0.04);  // of 0.25 m
  EXPECT_EQ(defect.report().at("pass_throughs").get<int>(), 0);
  EXPECT_LT(defect.closure(), 0.005);
}

class DefectsOfChosenSteps : public testing::TestWithParam<const char*> {};

// 6.4 to 18 % were seen: nodes that fall on a plane together; a wire that springs apart, whose
// speed shortened the step and let it grow again in each of its swings; what begins in each other;
// a wire that rattles in a plate which it went through; faces of a box that went through each
// other, or folded into one plane, and drew each other in (46 and 36 %); what glue without strength
// was said to give as it parted; ties that push and have no direction yet; ways out that
// turn. A tie as long as rounding is no reason for a short step.
TEST_P(DefectsOfChosenSteps, EndWithTheirEnergyClosedToASixteenth) {
  const Defect defect(GetParam(), {});

  ASSERT_EQ(defect.outcome().exit_code, 0) << defect.outcome().err;
  EXPECT_LT(defect.closure(), 1.0 / 16.0);
}

INSTANTIATE_TEST_SUITE_P(All, DefectsOfChosenSteps,
                         testing::Values("net_on_floor", "ring_on_floor", "wire_springs",
                                         "rings_in_each_other", "wire_through_plate", "crushed_box",
                                         "folded_nets", "weak_glue_on_planes", "ties_of_no_length",
                                         "float_on_a_rope", "tubes_through_each_other"),
                         test::name_of_parameter);

class DefectsOfFlatFalls : public testing::TestWithParam<const char*> {};

// Springs side by side carry a rigid body's mass together, and so do their dashpots. The last push
// is cut off where it would pull: 0.494 to 0.505 is seen between plates. On a plane a plate of many
// nodes rebounded at 0.29, 0.19 and 0.06 of 0.5 (now 0.500 to 0.502).
TEST_P(DefectsOfFlatFalls, ReboundAlikeHoweverThePlateIsCut) {
  for (const std::string cells : {"[1, 1]", "[2, 3]", "[6, 6]"}) {
    const Defect defect(GetParam(), {"rigid_bodies.b.shape.cells=" + cells});
    ASSERT_EQ(defect.outcome().exit_code, 0) << defect.outcome().err;
    const std::vector<Row> rows = defect.rows("rigid_bodies.csv");
    const double before = rows.front().at("b.velocity_z (m/s)");
    EXPECT_NEAR(rows.back().at("b.velocity_z (m/s)"), -0.5 * before, 0.01) << cells;
    EXPECT_NEAR(rows.back().at("b.angular_velocity_x (rad/s)"), 0.0, 1e-6) << cells;
  }
}

INSTANTIATE_TEST_SUITE_P(All, DefectsOfFlatFalls,
                         testing::Values("flat_plates", "flat_plate_on_plane"),
                         test::name_of_parameter);

// Each pair of a bar with a facet had a dashpot and a spring as if it were one contact, whatever
// its part of the length: bars rebounded at 0.32 to 0.91.
TEST(Defects, FlatBarsReboundAlikeHoweverTheyAndThePlateAreCut) {
  for (const std::string divisions : {"1", "16"}) {
    for (const std::string cells : {"[1, 1]", "[7, 7]"}) {
      const Defect defect("flat_bar", {"rigid_bodies.b.shape.divisions=" + divisions,
                                       "rigid_bodies.floor.shape.cells=" + cells});
      ASSERT_EQ(defect.outcome().exit_code, 0) << defect.outcome().err;
      const std::vector<Row> rows = defect.rows("rigid_bodies.csv");
      const double before = rows.front().at("b.velocity_z (m/s)");
      EXPECT_NEAR(rows.back().at("b.velocity_z (m/s)"), -0.5 * before, 0.005)
          << divisions << " on " << cells;
    }
  }
}

// Each foot had a dashpot for the mass of the whole table: 0.29.
TEST(Defects, ATableReboundsFromItsFeetAsItsLawSays) {
  const Defect defect("table", {});

  ASSERT_EQ(defect.outcome().exit_code, 0) << defect.outcome().err;
  const std::vector<Row> rows = defect.rows("rigid_bodies.csv");
  const double before = rows.front().at("b.velocity_z (m/s)");
  EXPECT_NEAR(rows.back().at("b.velocity_z (m/s)"), -0.5 * before, 0.005);
}

// A contact between bars whose energy is 0 but for rounding still has a force of rounding.
TEST(Defects, BarsThatRestDoNotEndAtNoNumber) {
  const Defect defect("tilted_y", {});

  ASSERT_EQ(defect.outcome().exit_code, 0) << defect.outcome().err;
  EXPECT_EQ(defect.report().at("status").get<std::string>(), "finished");
}

TEST(Defects, ABarThatBreaksInContactLeavesNothingBehind) {
  const Defect defect("crash_min", {});

  ASSERT_EQ(defect.outcome().exit_code, 0) << defect.outcome().err;
  EXPECT_EQ(defect.energy().back().at("broken_bonds"), 1.0);
  EXPECT_LT(defect.closure(), kClosed);
}

struct Stacked {
  const char* name;
  std::vector<std::string> settings;
  double thickness;           ///< m
  bool is_continuum = false;  ///< else of bars
};

void PrintTo(const Stacked& of, std::ostream* out) {
  *out << of.name;
}

class StackedSheets : public testing::TestWithParam<Stacked> {};

// Down by 1 mm, and up again. What was asked of the closure is 0.1 %; what the step at which they
// touch can be off by is (omega dt)² / 4 (tests/dynamics/together/stacked_sheets_test.cpp), 5 % at
// the chosen step. tests/validation/README.md has what is seen.
TEST_P(StackedSheets, BounceWithinTheErrorOfATouch) {
  const Stacked& of = GetParam();
  std::vector<std::string> settings = of.settings;
  settings.insert(settings.end(), {"simulation.duration=0.025", "output.history_interval=1e-6"});

  const Defect defect("stacked", settings);

  ASSERT_EQ(defect.outcome().exit_code, 0) << defect.outcome().err;
  EXPECT_EQ(defect.report().at("status").get<std::string>(), "finished");
  const std::vector<Row> rows = defect.energy();
  double step = 0.0;  // s, the longest in which sheets touch or part
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].at("contact_elastic (J)") > 0.0 || rows[i - 1].at("contact_elastic (J)") > 0.0)
      step = std::max({step, rows[i].at("time_step (s)"), rows[i - 1].at("time_step (s)")});
  }
  ASSERT_GT(step, 0.0);
  EXPECT_EQ(rows.back().at("contact_elastic (J)"), 0.0);
  // 10 x 10 cells of 0.1 m: sides along both axes, diagonals.
  constexpr double kLength = 2.0 * 11.0 + 10.0 * std::numbers::sqrt2;  // m, of all bars
  const double radius = 0.5 * of.thickness;
  const double mass =
      1000.0 * (of.is_continuum ? of.thickness : std::numbers::pi * radius * radius * kLength);
  const double stiffness = 2e6 * radius / (of.thickness * of.thickness);  // N/m, of 1 m²
  EXPECT_LT(defect.closure(), 0.25 * stiffness / mass * step * step);
}

INSTANTIATE_TEST_SUITE_P(
    All, StackedSheets,
    testing::Values(
        Stacked{"registered", {}, 0.01},
        Stacked{"shifted by 1e-9 m", {"membranes.upper.translate=[1e-9, 0, 0.011]"}, 0.01},
        Stacked{"shifted by 13.7 mm", {"membranes.upper.translate=[0.0137, 0, 0.011]"}, 0.01},
        Stacked{"on two triangles", {"membranes.ground.shape.cells=[1, 1]"}, 0.01},
        Stacked{"2 mm thick",
                {"membranes.upper.translate=[0, 0, 0.003]", "membranes.upper.thickness=0.002",
                 "membranes.ground.thickness=0.002"},
                0.002},
        Stacked{"continua",
                {"membranes.upper.mode=\"continuum\"", "membranes.ground.mode=\"continuum\""},
                0.01,
                true}),
    test::name_of_parameter);

struct Refused {
  const char* name;
  const char* what;
};

void PrintTo(const Refused& of, std::ostream* out) {
  *out << of.name;
}

class DefectsOfStarts : public testing::TestWithParam<Refused> {};

TEST_P(DefectsOfStarts, AreRefusedByRunAndToldByCheck) {
  const auto& [name, what] = GetParam();

  const Defect run(name, {});
  const Outcome check = outcome_of({"check", file_of(name)});

  EXPECT_EQ(run.outcome().exit_code, 1);
  EXPECT_THAT(run.outcome().err, HasSubstr(what));
  EXPECT_THAT(check.out + check.err, testing::Not(HasSubstr("no problems")));
  EXPECT_THAT(check.out + check.err, HasSubstr(what));
}

INSTANTIATE_TEST_SUITE_P(
    All, DefectsOfStarts,
    testing::Values(
        Refused{"24_overlap_centres", "begins in grains.b at 1 place, deeper than both radii"},
        Refused{"gr_in_floor", "begins behind planes[0]"},
        Refused{"behind_plane_1108", "begin behind planes.top"},
        Refused{"coinciding_sheets", "begins in membranes.b at 1 place, deeper than both radii"},
        Refused{"x_thick", "begin behind planes.floor"}),
    test::name_of_parameter);

// 10 000 cells of which each is nearer than a thickness to a thousand others: some minutes if every
// pair were asked.
TEST(Defects, ASheetThickerThanItsCellsIsSetUp) {
  const Outcome check =
      outcome_of({"check", file_of("x_thick"), "--set", "membranes.m.translate=[0, 0, 1]"});

  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_THAT(check.out, HasSubstr("no problems"));
}

// Shells whose cores cross from 28 ms on: forces turn from one step to the next as what is the
// shortest way out changes. 0.20 % is seen at the chosen step, 0.04 and 0.06 % at a half and a
// quarter of it.
TEST(Defects, ShellsThatCrossKeepTheirEnergyAndAreNotPassedOverInSilence) {
  const Defect defect("spin_20130", {});

  ASSERT_EQ(defect.outcome().exit_code, 0) << defect.outcome().err;
  EXPECT_GT(defect.report().at("most_crossings").get<int>(), 0);
  EXPECT_THAT(defect.outcome().err,
              HasSubstr("membranes went into each other by more than both half thicknesses"));
  EXPECT_LT(defect.closure(), 0.01);
}

}  // namespace
}  // namespace plekton::apps::defects_test
