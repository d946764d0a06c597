// SPDX-License-Identifier: GPL-3.0-or-later
// The certificate at the end of a run, and what --strict makes of it.
#include "tests/apps/command_line/command_fixture.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plekton::apps::certificate_command_test {
namespace {

using testing::HasSubstr;

class CertificateCommand : public Command {};

TEST_F(CertificateCommand, EndsARunAndIsInItsReport) {
  const Outcome outcome = outcome_of({"run", scenario(), "--out", out(), "--strict"});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("certificate: 12 of 12 green\n"));
  ASSERT_EQ(report()["certificate"].size(), 12U);
  const auto written = report();
  for (const auto& check : written["certificate"]) {
    EXPECT_EQ(check["verdict"], "green") << check;
    EXPECT_FALSE(check.contains("advice")) << check;
  }
  EXPECT_EQ(report()["certificate"].back()["name"], "hash_chain");
  EXPECT_EQ(report()["certificate"].back()["value"], report()["states"]["chain"]);
  EXPECT_TRUE(report()["certificate"].back()["limit"].is_null());
  EXPECT_THAT(outcome.out, HasSubstr(fmt::format(
                               "decisions beyond doubles: {} by pairs, {} by intervals, {} exact",
                               report()["exact_decisions"]["double_double"].get<int>(),
                               report()["exact_decisions"]["interval"].get<int>(),
                               report()["exact_decisions"]["exact"].get<int>())));
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

/// A net whose beams break under a boulder.
TEST_F(CertificateCommand, TellsOfBrokenBondsWithoutAVerdictAgainstThem) {
  const Outcome outcome =
      outcome_of({"run", "tests/same_bits/scenes/net.toml", "--out", out(), "--overwrite"});

  ASSERT_EQ(outcome.exit_code, kDone) << outcome.out;
  const auto certificate = report()["certificate"];
  const auto row = std::find_if(certificate.begin(), certificate.end(),
                                [](const auto& one) { return one["name"] == "broken_bonds"; });
  ASSERT_NE(row, certificate.end());
  ASSERT_GT(report()["counts"]["broken_bonds"], 0);
  EXPECT_EQ((*row)["value"], report()["counts"]["broken_bonds"]);
  EXPECT_EQ((*row)["verdict"], "green");
  EXPECT_TRUE((*row)["limit"].is_null());
  EXPECT_THAT((*row)["advice"].get<std::string>(), HasSubstr("bonds broke"));
}

}  // namespace
}  // namespace plekton::apps::certificate_command_test
