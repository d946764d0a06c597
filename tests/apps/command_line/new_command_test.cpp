// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/new_command.hpp"

#include "tests/apps/command_line/program_fixture.hpp"

#include <gmock/gmock.h>

namespace plekton::apps::new_command_test {
namespace {

using testing::HasSubstr;

class New : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
};

TEST_F(New, WritesAScenarioThatRunsWithoutAWarning) {
  const std::string file = (folder_ / "first.toml").string();
  const Outcome written = outcome_of({"new", file});
  const Outcome run =
      outcome_of({"run", file, "--out", (folder_ / "out").string(), "--strict", "--quiet"});

  EXPECT_EQ(written.exit_code, kDone) << written.err;
  EXPECT_THAT(written.out, HasSubstr("plekton run " + file));
  EXPECT_EQ(run.exit_code, kDone) << run.err;
  EXPECT_EQ(run.err, "");
}

TEST_F(New, TellsCommandsThatCanBeTypedForAnyName) {
  const std::string file = (folder_ / "a b.toml").string();

  EXPECT_EQ(outcome_of({"new", file}).out, "wrote " + file + "\ncheck it: plekton check '" + file +
                                               "'\nrun it:   plekton run '" + file +
                                               "'\nlook at:  plekton view 'out/a b'\n");
}

TEST_F(New, TellsCommandsThatTakeANameWithADashForAPath) {
  const auto here = [&] { std::filesystem::current_path(folder_.path()); };

  const Outcome written = outcome_of({"new", "--", "-x.toml"}, here);

  EXPECT_EQ(written.exit_code, kDone) << written.err;
  EXPECT_THAT(written.out, HasSubstr("plekton check ./-x.toml\n"));
  EXPECT_EQ(outcome_of({"check", "./-x.toml"}, here).exit_code, kDone);
}

TEST_F(New, DoesNotReplaceAFile) {
  test::write_bytes(folder_ / "first.toml", "mine");

  const Outcome outcome = outcome_of({"new", (folder_ / "first.toml").string()});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("is there already"));
  EXPECT_EQ(test::bytes_of(folder_ / "first.toml"), "mine");
}

TEST_F(New, SaysThatAFileIsWanted) {
  // "-" is standard input for the commands that would read it.
  for (const std::string& file : {std::string(), folder_.path().string() + "/", std::string("-")}) {
    const Outcome outcome = outcome_of({"new", file});

    EXPECT_EQ(outcome.exit_code, kFailed);
    EXPECT_THAT(outcome.err,
                HasSubstr("got \"" + file + "\" as the scenario to write; expected a file"));
  }
}

}  // namespace
}  // namespace plekton::apps::new_command_test
