// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/examples_command.hpp"

#include "apps/scenario/scenario_reader.hpp"
#include "tests/apps/command_line/program_fixture.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <sstream>

namespace plekton::apps::examples_command_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Examples : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
};

TEST_F(Examples, AreListedWithWhatTheySayOfThemselves) {
  const Outcome outcome = outcome_of({"examples"});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("catch              A thousand grains of gravel"));
  EXPECT_THAT(outcome.out, HasSubstr("own_law            (C++) A contact law of one's own"));
}

TEST_F(Examples, AreCopiedWithAllTheirFilesAndStillRead) {
  const fs::path target = folder_ / "mine";
  const Outcome outcome = outcome_of({"examples", "catch", "--out", target.string()});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("plekton run " + (target / "catch.toml").string()));
  EXPECT_NO_THROW(read_scenario(target / "catch.toml"));
}

/// A check that finds all that it imports asks for runs.
TEST_F(Examples, AreCopiedWithWhatTheirChecksNeed) {
  const fs::path target = folder_ / "mine";
  ASSERT_EQ(outcome_of({"examples", "tyre", "--out", target.string()}).exit_code, kDone);

  const std::string command =
      "python3 -B " + (target / "check.py").string() + " 2> " + (folder_ / "said").string();
  EXPECT_NE(std::system(command.c_str()), 0);
  EXPECT_THAT(test::bytes_of(folder_ / "said"), HasSubstr("python3 check.py RUN"));
}

TEST_F(Examples, TellCommandsThatCanBeTypedForAnyFolder) {
  const fs::path target = folder_ / "my own";
  const Outcome outcome = outcome_of({"examples", "catch", "--out", target.string()});

  EXPECT_THAT(outcome.out, HasSubstr("plekton run '" + (target / "catch.toml").string() + "'\n"));
}

TEST_F(Examples, AllAreScenariosThatCanBeRead) {
  int scenarios = 0;
  for (const Example& example : find_examples(examples_folder())) {
    EXPECT_FALSE(example.what.empty()) << example.name;
    if (example.is_program()) continue;
    ++scenarios;
    EXPECT_NO_THROW(read_scenario(example.main)) << example.main;
  }
  EXPECT_GE(scenarios, 3);
}

TEST_F(Examples, AreNotListedIntoAFolder) {
  const Outcome outcome = outcome_of({"examples", "--out", (folder_ / "x").string()});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr("without the name of an example"));
}

TEST_F(Examples, DoNotReplaceFiles) {
  const std::string target = folder_.path().string();
  test::write_bytes(folder_ / "own_law.cpp", "mine");

  const Outcome outcome = outcome_of({"examples", "own_law", "--out", target});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("is there already"));
  EXPECT_EQ(test::bytes_of(folder_ / "own_law.cpp"), "mine");
}

TEST_F(Examples, AreSuggestedForAnUnknownName) {
  const Outcome outcome = outcome_of({"examples", "cath"});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("did you mean \"catch\"?"));
}

}  // namespace
}  // namespace plekton::apps::examples_command_test
