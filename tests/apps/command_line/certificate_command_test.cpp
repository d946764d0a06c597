// SPDX-License-Identifier: GPL-3.0-or-later
// The certificate at the end of a run, and what --strict makes of it.
#include "tests/apps/command_line/command_fixture.hpp"

namespace plekton::apps {
namespace {

using testing::HasSubstr;

class CertificateCommand : public Command {};

TEST_F(CertificateCommand, EndsARunAndIsInItsReport) {
  const Outcome outcome = outcome_of({"run", scenario(), "--out", out(), "--strict"});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("certificate: 10 of 10 green\n"));
  ASSERT_EQ(report()["certificate"].size(), 10U);
  for (const auto& check : report()["certificate"]) {
    EXPECT_EQ(check["verdict"], "green") << check;
    EXPECT_FALSE(check.contains("advice")) << check;
  }
  EXPECT_THAT(outcome.out,
              HasSubstr(", chain " + report()["states"]["chain"].get<std::string>() + '\n'));
}

/// Two hollow balls that go deep into each other.
TEST_F(CertificateCommand, RefusesARedOneOnlyIfAsked) {
  const std::vector<std::string> run = {"run", "tests/apps/run/scenes/shells.toml", "--out", out(),
                                        "--overwrite"};
  std::vector<std::string> strict = run;
  strict.push_back("--strict");

  const Outcome outcome = outcome_of(run);
  EXPECT_EQ(outcome.exit_code, kDone);
  EXPECT_THAT(outcome.out, HasSubstr("red: largest_overlap_ratio"));
  EXPECT_EQ(outcome_of(strict).exit_code, kRed);
  EXPECT_EQ(report()["status"], "finished");
  const auto overlap = report()["certificate"][0];
  EXPECT_EQ(overlap["name"], "largest_overlap_ratio");
  EXPECT_EQ(overlap["verdict"], "red");
  EXPECT_THAT(overlap["advice"].get<std::string>(), HasSubstr("raise young_modulus"));
}

}  // namespace
}  // namespace plekton::apps
