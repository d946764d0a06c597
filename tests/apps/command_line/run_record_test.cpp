// SPDX-License-Identifier: GPL-3.0-or-later
// What a folder of results says of how they were made.
#include "tests/apps/command_line/command_fixture.hpp"

namespace plekton::apps {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

class RunRecord : public Command {
 protected:
  std::string copy() const { return test::bytes_of(folder_ / "out/scenario-as-run.toml"); }
};

TEST_F(RunRecord, SaysWhenWhereAndWithWhatTheRunWasMade) {
  ASSERT_EQ(outcome_of({"run", scenario(), "--out", out()}).exit_code, kDone);

  const auto json = report();
  EXPECT_THAT(std::string(json["date"]),
              MatchesRegex("20[0-9][0-9]-[0-9][0-9]-[0-9][0-9]T[0-9][0-9]:[0-9][0-9]:[0-9][0-9]Z"));
  EXPECT_TRUE(json["host"].is_string());
  // Of the repository, or the version without one.
  EXPECT_THAT(std::string(json["revision"]), MatchesRegex("[0-9a-f]+(-modified)?|[0-9.]+"));
  EXPECT_THAT(std::string(json["compiler"]), MatchesRegex("[A-Za-z]+ [0-9.]+"));
}

TEST_F(RunRecord, HasTheScenarioAsItWasRun) {
  const Outcome outcome = outcome_of(
      {"run", scenario(), "--out", out(), "--threads", "2", "--set", "grains.gravel.count=10"});
  ASSERT_EQ(outcome.exit_code, kDone);

  EXPECT_THAT(copy(), StartsWith(std::string(kScenario)));
  EXPECT_THAT(copy(), HasSubstr("\n# --set grains.gravel.count=10\n"));
  EXPECT_THAT(copy(), HasSubstr("\n# --set simulation.threads=2\n"));
  EXPECT_THAT(copy(), HasSubstr("relative to " + folder_.path().string()));
  EXPECT_THAT(outcome.out, HasSubstr("energy.csv, scenario-as-run.toml, and for ParaView"));
}

TEST_F(RunRecord, IsThatOfTheLastRunIntoAFolder) {
  outcome_of({"run", scenario(), "--out", out(), "--set", "grains.gravel.count=10"});

  outcome_of({"run", scenario(), "--out", out(), "--overwrite"});

  EXPECT_EQ(copy().find("count=10"), std::string::npos);
}

TEST_F(RunRecord, CanBeRunIntoItsOwnFolderAndIsNotReplacedThen) {
  std::filesystem::create_directory(out());
  std::filesystem::copy_file(folder_ / "sheet.off", folder_ / "out/sheet.off");
  const std::string file = (folder_ / "out/scenario-as-run.toml").string();
  test::write_bytes(file, std::string(kScenario));

  const Outcome outcome = outcome_of({"run", file, "--out", out(), "--overwrite"});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_EQ(copy(), kScenario);
}

}  // namespace
}  // namespace plekton::apps
