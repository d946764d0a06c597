// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/study/run_results.hpp"

#include "tests/support/temporary_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plekton::apps::run_results_test {
namespace {

using testing::HasSubstr;

class RunResults : public testing::Test {
 protected:
  RunResults() {
    test::write_bytes(folder_ / "run.json",
                      R"({"plekton": "0", "timing": {"steps": 12}, "list": [{"x": 0.5}]})");
    test::write_bytes(folder_ / "reactions.csv",
                      "time (s),floor.force_z (N)\n0,1\n1,3\n2,-2\n4,5\n");
  }
  RunResult result(const ResultSettings& settings) const {
    return results_of(folder_.path(), std::span(&settings, 1))[0];
  }
  std::string problem(const ResultSettings& settings) const {
    try {
      result(settings);
    } catch (const NoResult& error) {
      return error.what();
    }
    return "";
  }
  static ResultSettings force(Take take) {
    ResultSettings settings;
    settings.name = "force";
    settings.file = "reactions.csv";
    settings.column = "floor.force_z";
    settings.take = take;
    return settings;
  }
  static ResultSettings report(const std::string& path) {
    ResultSettings settings;
    settings.name = "it";
    settings.report = path;
    return settings;
  }

  test::TemporaryFolder folder_;
};

TEST_F(RunResults, OfAPathThatARunMayHaveAreNotRefusedBeforeThereIsOne) {
  for (const char* path :
       {"timing.steps", "energy.kinetic_J", "deepest_overlap.depth_m", "resumed_s", "stopped_by",
        "message", "stages.0.end_s", "certificate.3.value", "energy_closure", "warnings.0",
        "states.chain", "names.grains.0"})
    EXPECT_EQ(problem_with_report(path), "") << path;
  EXPECT_THAT(problem_with_report("energy.kinetik_J"), HasSubstr("did you mean \"kinetic_J\"?"));
  EXPECT_THAT(problem_with_report("energy_closure.x"), HasSubstr("there is no \"x\""));
  EXPECT_THAT(problem_with_report("timing"), HasSubstr("is no single value"));
  EXPECT_EQ(problem_with_column("energy.csv", "time_step"), "");
  EXPECT_EQ(problem_with_column("reactions.csv", "what the scenario names"), "");
  EXPECT_EQ(problem_with_file("ties.csv"), "");
  EXPECT_EQ(problem_with_file("planes.csv"), "");
}

TEST_F(RunResults, OfAMeasureAreThoseOfItsFileInTheFolderOfMeasures) {
  EXPECT_EQ(problem_with_file("measures/core.csv"), "");
  EXPECT_EQ(problem_with_column("measures/core.csv", "porosity"), "");
  EXPECT_THAT(problem_with_column("measures/core.csv", "prosity"),
              HasSubstr("measures/core.csv has no column \"prosity\"; did you mean \"porosity\"?"));
  for (const char* file :
       {"measures/../run.csv", "measures/a/b.csv", "/measures/a.csv", "core.json",
        "../measures/core.csv", "measures/.csv", "measures//core.csv"})
    EXPECT_THAT(problem_with_file(file), HasSubstr("\"measures/NAME.csv\", of a measure")) << file;
  EXPECT_THAT(problem_with_file("plans.csv"), HasSubstr("did you mean \"planes.csv\"?"));

  std::filesystem::create_directory(folder_ / "measures");
  test::write_bytes(folder_ / "measures/core.csv", "time (s),porosity\n0,0.5\n1,0.25\n");
  ResultSettings settings = force(Take::min);
  settings.file = "measures/core.csv";
  settings.column = "porosity";
  EXPECT_EQ(result(settings).text, "0.25");
  EXPECT_EQ(result(settings).unit, "");
  settings.column = "rattlers";
  EXPECT_THAT(problem(settings), HasSubstr("measures/core.csv has no column \"rattlers\""));
}

TEST_F(RunResults, AreTheValuesOfAColumnThatWereAskedFor) {
  EXPECT_EQ(result(force(Take::last)).text, "5");
  EXPECT_EQ(result(force(Take::last)).unit, "N");
  EXPECT_EQ(result(force(Take::first)).text, "1");
  EXPECT_EQ(result(force(Take::max)).text, "5");
  EXPECT_EQ(result(force(Take::min)).text, "-2");
  EXPECT_EQ(result(force(Take::change)).text, "4");
  // (1/2 (1 + 3) 1 + 1/2 (3 - 2) 1 + 1/2 (-2 + 5) 2) / 4
  EXPECT_EQ(result(force(Take::mean)).text, "1.375");
}

TEST_F(RunResults, AreOfTheTimesThatWereAskedFor) {
  ResultSettings settings = force(Take::max);
  settings.from = 0.5;
  settings.to = 2.0;
  EXPECT_EQ(result(settings).text, "3");
  settings = force(Take::last);
  settings.at = 3.0;
  EXPECT_EQ(result(settings).text, "1.5");
  settings.at = 4.0;
  EXPECT_EQ(result(settings).text, "5");
  settings.at = 4.5;
  EXPECT_THAT(problem(settings), HasSubstr("no row at 4.5 s; it goes from 0 s to 4 s"));
  settings = force(Take::mean);
  settings.from = 4.5;
  EXPECT_THAT(problem(settings), HasSubstr("no row from 4.5 s to 4 s"));
}

TEST_F(RunResults, LeaveOutRowsWithoutAValue) {
  test::write_bytes(folder_ / "reactions.csv",
                    "time (s),floor.force_z (N)\n0,nan\n1,1\n2,5\n3,nan\n4,3\n5,nan\n");

  EXPECT_EQ(result(force(Take::first)).text, "1");
  EXPECT_EQ(result(force(Take::last)).text, "3");
  EXPECT_EQ(result(force(Take::max)).text, "5");
  EXPECT_EQ(result(force(Take::min)).text, "1");
  EXPECT_EQ(result(force(Take::change)).text, "2");
  // (1/2 (1 + 5) 1 + 1/2 (5 + 3) 2) / 3
  EXPECT_EQ(result(force(Take::mean)).text, fmt::format("{}", 11.0 / 3.0));
}

TEST_F(RunResults, AreRefusedWhereNoRowHasAValue) {
  test::write_bytes(folder_ / "reactions.csv", "time (s),floor.force_z (N)\n0,nan\n1,nan\n2,5\n");
  for (const Take take :
       {Take::first, Take::last, Take::max, Take::min, Take::mean, Take::change}) {
    ResultSettings settings = force(take);
    settings.to = 1.5;
    EXPECT_THAT(problem(settings),
                HasSubstr("no value of \"floor.force_z\" from 0 s to 1 s: it is nan in all rows"));
  }
  ResultSettings settings = force(Take::last);
  settings.at = 1.5;
  EXPECT_THAT(problem(settings), HasSubstr("no value of \"floor.force_z\" at 1.5 s"));
  settings.at = 2.0;
  EXPECT_EQ(result(settings).text, "5");
}

// The last step may end 1e-3 of it before the end of the run.
TEST_F(RunResults, OfTheEndOfARunAreThoseOfItsLastRow) {
  test::write_bytes(folder_ / "reactions.csv", "time (s),floor.force_z (N)\n0,1\n1,3\n1.99999,7\n");

  ResultSettings settings = force(Take::last);
  settings.at = 2.0;
  EXPECT_EQ(result(settings).text, "7");
  settings.at = 2.01;
  EXPECT_THAT(problem(settings), HasSubstr("no row at 2.01 s"));
  settings = force(Take::last);
  settings.from = 2.0;
  EXPECT_EQ(result(settings).text, "7");
}

TEST_F(RunResults, OfOneRowAreThoseOfItsTimeAlone) {
  test::write_bytes(folder_ / "reactions.csv", "time (s),floor.force_z (N)\n1,3\n");

  ResultSettings settings = force(Take::last);
  settings.at = 1.0;
  EXPECT_EQ(result(settings).text, "3");
  settings.at = 1.001;
  EXPECT_THAT(problem(settings), HasSubstr("no row at 1.001 s"));
}

TEST_F(RunResults, AreValuesOfTheReport) {
  EXPECT_EQ(result(report("timing.steps")).text, "12");
  EXPECT_EQ(result(report("list.0.x")).text, "0.5");
  EXPECT_THAT(problem(report("timing.stps")), HasSubstr("did you mean \"steps\"?"));
  EXPECT_THAT(problem(report("timing")), HasSubstr("is no single value"));
  EXPECT_THAT(problem(report("list.1.x")), HasSubstr("there is no \"1\""));
}

TEST_F(RunResults, SayWhichFileIsMissing) {
  ResultSettings settings = force(Take::last);
  settings.file = "pressures.csv";

  EXPECT_THAT(problem(settings), HasSubstr("the run has written no pressures.csv"));
}

}  // namespace
}  // namespace plekton::apps::run_results_test
