// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/study/study.hpp"

#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plekton::apps::study_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class StudyFile : public testing::Test {
 protected:
  StudyFile() { test::write_bytes(folder_ / "case.toml", "[simulation]\n"); }

  Study read(const std::string& text) const {
    test::write_bytes(folder_ / "many.toml", "scenario = \"case.toml\"\n" + text);
    return read_study(folder_ / "many.toml");
  }
  std::string problem(const std::string& text) const {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  static constexpr const char* kResults = "[results]\nsteps = { report = \"timing.steps\" }\n";
  test::TemporaryFolder folder_;
};

TEST_F(StudyFile, TakesEveryCombinationOfAGridTheLastParameterFirst) {
  const Study study =
      read(std::string("[set]\nsimulation.duration = \"1 s\"\n"
                       "[grid]\n\"planes.0.point\" = [[0, 0, 1], [0, 0, 2]]\n"
                       "materials.sand.friction_angle = [\"20 deg\", \"30 deg\"]\n") +
           kResults);

  EXPECT_THAT(study.parameters, ElementsAre("planes.0.point", "materials.sand.friction_angle"));
  ASSERT_EQ(study.points.size(), 4U);
  EXPECT_THAT(overrides_of(study, 1),
              ElementsAre("simulation.duration=1 s", "planes.0.point=[0, 0, 1]",
                          "materials.sand.friction_angle=30 deg"));
  EXPECT_THAT(study.points[2].values, ElementsAre("[0, 0, 2]", "20 deg"));
}

TEST_F(StudyFile, PutsASobolSequenceIntoRangesOnTheScalesAskedFor) {
  const Study study =
      read(std::string("[sobol]\nruns = 3\n[sobol.parameters]\n"
                       "a.angle = { from = \"20 deg\", to = \"40 deg\" }\n"
                       "a.modulus = { from = \"1 MPa\", to = \"100 MPa\", scale = \"log\" }\n"
                       "a.count = { from = 1, to = 4, whole = true }\n") +
           kResults);

  ASSERT_EQ(study.points.size(), 3U);
  EXPECT_THAT(study.points[0].values, ElementsAre("20 deg", "1 MPa", "1"));
  EXPECT_THAT(study.points[1].values, ElementsAre("30 deg", "10 MPa", "3"));
  EXPECT_THAT(study.points[2].values, ElementsAre("35 deg", "3.16227766 MPa", "2"));
}

TEST_F(StudyFile, KeepsAllDigitsOfWholeNumbersOfASobolSequence) {
  const Study study = read(std::string("[sobol]\nruns = 4\n[sobol.parameters]\n"
                                       "a.seed = { from = 1, to = 4000000000, whole = true }\n") +
                           kResults);

  // 1 + u 4e9 for u = 0, 1/2, 3/4, 1/4
  ASSERT_EQ(study.points.size(), 4U);
  EXPECT_THAT(study.points[0].values, ElementsAre("1"));
  EXPECT_THAT(study.points[1].values, ElementsAre("2000000001"));
  EXPECT_THAT(study.points[2].values, ElementsAre("3000000001"));
  EXPECT_THAT(study.points[3].values, ElementsAre("1000000001"));
}

TEST_F(StudyFile, TakesATableWhereAnEmptyCellLeavesTheScenarioAsItIs) {
  test::write_bytes(folder_ / "runs.csv", "simulation.seed,simulation.damping\n1,\n2,0.5\n");

  const Study study = read(std::string("table = \"runs.csv\"\n") + kResults);

  ASSERT_EQ(study.points.size(), 2U);
  EXPECT_THAT(overrides_of(study, 0), ElementsAre("simulation.seed=1"));
  EXPECT_THAT(overrides_of(study, 1), ElementsAre("simulation.seed=2", "simulation.damping=0.5"));
  EXPECT_THAT(to_string(study.points[1].place), HasSubstr("runs.csv:3:"));
}

TEST_F(StudyFile, IsRefusedWithThePlaceOfWhatIsWrong) {
  const std::string results = kResults;
  EXPECT_THAT(problem(results), HasSubstr("got none of [grid], [sobol] and table"));
  EXPECT_THAT(problem("[grid]\na.b = 3\n" + results),
              AllOf(HasSubstr("many.toml:3:7"), HasSubstr("grid.a.b: got 3; expected a list")));
  EXPECT_THAT(problem("[grid]\na.b = [3]\n\"a.b\" = [4]\n" + results), HasSubstr("is there twice"));
  EXPECT_THAT(problem("[grid]\na = [3]\n"), HasSubstr("results: missing"));
  EXPECT_THAT(problem("jops = 3\n[grid]\na = [3]\n" + results),
              AllOf(HasSubstr("many.toml:2:"), HasSubstr("did you mean \"jobs\"?")));
  EXPECT_THAT(problem("table = \"none.csv\"\n" + results),
              AllOf(HasSubstr("many.toml:2:"), HasSubstr("is no file")));
  const std::string sobol = "[sobol]\nruns = 4\n[sobol.parameters]\n";
  EXPECT_THAT(problem(sobol + "a = { from = \"1 m\", to = \"20 mm\" }\n" + results),
              HasSubstr("expected the same unit"));
  EXPECT_THAT(problem(sobol + "a = { from = 2, to = 1 }\n" + results),
              HasSubstr("sobol.parameters.a.to: expected more than from"));
  EXPECT_THAT(problem(sobol + "a = { from = 0, to = 1, scale = \"log\" }\n" + results),
              HasSubstr("the scale is logarithmic"));
  EXPECT_THAT(problem("[grid]\na = [1]\n[results]\nf = { file = \"../x.csv\", column = \"y\" }\n"),
              HasSubstr("expected a CSV file of the run"));
  EXPECT_THAT(problem("[grid]\na = [1]\n[results]\nf = { column = \"y\", take = \"lst\" }\n"),
              AllOf(HasSubstr("results.f.take"), HasSubstr("did you mean \"last\"?")));
}

TEST_F(StudyFile, TakesAnEmptyCellInQuotesForARunWhereATableHasOneColumn) {
  test::write_bytes(folder_ / "runs.csv", "simulation.seed\n1\n\"\"\n\n3\n");

  const Study study = read(std::string("table = \"runs.csv\"\n") + kResults);

  ASSERT_EQ(study.points.size(), 3U);
  EXPECT_THAT(overrides_of(study, 1), testing::IsEmpty());
  EXPECT_THAT(overrides_of(study, 2), ElementsAre("simulation.seed=3"));
}

TEST_F(StudyFile, RefusesResultsWithTheNameOfAnotherColumn) {
  for (const char* name : {"run", "status", "problem", "key"})
    EXPECT_THAT(problem(std::string("[grid]\na.b = [1]\n[results]\n") + name +
                        " = { report = \"timing.steps\" }\n"),
                AllOf(HasSubstr("many.toml:5:"), HasSubstr(std::string("results.") + name),
                      HasSubstr("a column that every results.csv has")));
  EXPECT_THAT(problem("[grid]\na.b = [1]\n[results]\n"
                      "\"a.b\" = { report = \"timing.steps\" }\n"),
              HasSubstr("results.a.b: got the name of a column that is of a parameter"));
}

TEST_F(StudyFile, NamesEveryRowOfATableThatDoesNotFit) {
  test::write_bytes(folder_ / "runs.csv", "a.x,b.x\n1,2\n3\n1,2,3\n");

  EXPECT_THAT(problem(std::string("table = \"runs.csv\"\n") + kResults),
              AllOf(HasSubstr("runs.csv:3:1: got 1 cells; expected 2"),
                    HasSubstr("runs.csv:4:1: got 3 cells")));
}

// `"0.001" ms` was read as 0.001, without a word.
TEST_F(StudyFile, RefusesATableWithTextBehindAQuoteOrAQuoteThatIsNotClosed) {
  test::write_bytes(folder_ / "b.csv", "simulation.duration\n\"0.001\" ms\n1\n\"2\n");

  EXPECT_THAT(problem(std::string("table = \"b.csv\"\n") + kResults),
              AllOf(HasSubstr("b.csv:2:1: cell 1: got \"ms\" behind a closing quote"),
                    HasSubstr("b.csv:4:1: cell 1: got a quote that is not closed")));
}

TEST_F(StudyFile, TellsNothingOfATableWhoseFirstRowIsNoneOfPaths) {
  for (const std::string head :
       {"root:x:0:0:root:/root", "a secret line", "secret", "a.b,", "\"a.\"b secret", "\"secret"}) {
    SCOPED_TRACE(head);
    test::write_bytes(folder_ / "b.csv", head + "\nhidden\n");
    EXPECT_THAT(problem(std::string("table = \"b.csv\"\n") + kResults),
                AllOf(HasSubstr("table: the first row of "), HasSubstr("is not one of paths"),
                      Not(HasSubstr("secret")), Not(HasSubstr("root")), Not(HasSubstr("hidden"))));
  }
}

TEST_F(StudyFile, RefusesNamesOfResultsThatASpreadsheetTakesForFormulas) {
  for (const std::string name : {"=a", "+a", "-a", "@a", "  =a"})
    EXPECT_THAT(
        problem("[grid]\na.b = [1]\n[results]\n\"" + name + "\" = { report = \"timing.steps\" }\n"),
        AllOf(HasSubstr("many.toml:5:"),
              HasSubstr("results." + name + ": got \"" + name +
                        "\"; expected a name that does not begin with = + - or @")));
}

TEST_F(StudyFile, KnowsAScenarioAndNamesItsCommand) {
  try {
    read_study(folder_ / "case.toml");
    FAIL() << "a scenario was read as a study";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("case.toml:1:2: simulation: this file is a scenario"),
                                    HasSubstr("`plekton run`"), Not(HasSubstr("missing"))));
  }
}

TEST_F(StudyFile, RefusesMoreRunsThanItCanCount) {
  std::string grid = "[grid]\n";
  for (const char* name : {"a", "b", "c", "d", "e", "f"})
    grid += std::string(name) + " = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]\n";

  EXPECT_THAT(problem(grid + kResults), HasSubstr("expected at most 100000 runs"));
}

}  // namespace
}  // namespace plekton::apps::study_test
