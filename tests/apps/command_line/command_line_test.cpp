// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/apps/command_line/program_fixture.hpp"

#include <gmock/gmock.h>

namespace plekton::apps::command_line_test {
namespace {

using testing::HasSubstr;

TEST(CommandLine, ThatCannotBeUnderstoodEndsWithTwo) {
  EXPECT_EQ(outcome_of({}).exit_code, kUsage);
  EXPECT_EQ(outcome_of({"fly"}).exit_code, kUsage);
  EXPECT_THAT(outcome_of({"fly"}).err, HasSubstr("the commands are \"run\""));
  EXPECT_THAT(outcome_of({"chekc"}).err, HasSubstr("did you mean \"check\"?"));
  EXPECT_EQ(outcome_of({"run"}).exit_code, kUsage);
  EXPECT_EQ(outcome_of({"run", "case.toml", "--threads", "many"}).exit_code, kUsage);
}

TEST(CommandLine, HelpsAndTellsItsVersion) {
  EXPECT_EQ(outcome_of({"--help"}).exit_code, kDone);
  EXPECT_THAT(outcome_of({"run", "--help"}).out, HasSubstr("--set"));
  EXPECT_THAT(outcome_of({"--version"}).out, HasSubstr("0."));
}

TEST(CommandLine, NamesAScenarioThatDoesNotExist) {
  const Outcome outcome = outcome_of({"run", "/nowhere/case.toml"});
  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("/nowhere/case.toml: no such file"));
}

}  // namespace
}  // namespace plekton::apps::command_line_test
