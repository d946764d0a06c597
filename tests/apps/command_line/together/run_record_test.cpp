// SPDX-License-Identifier: GPL-3.0-or-later
// What a folder of results says of how they were made, and of the deepest overlap in them.
#include "tests/apps/command_line/command_fixture.hpp"

#include <cmath>
#include <numbers>

namespace plekton::apps::run_record_test {
namespace {

using testing::AllOf;
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
  EXPECT_THAT(outcome.out,
              HasSubstr("energy.csv, planes.csv, scenario-as-run.toml, checkpoints, and for "));
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

/// Two equal grains that meet in the origin, and a third one far away.
constexpr std::string_view kCollision = R"([simulation]
duration = "4 ms"
gravity = [0, 0, 0]
[materials.rubber]
density = "2650 kg/m3"
young_modulus = "1 MPa"
friction_angle = "20 deg"
[[grains]]
name = "left"
material = "rubber"
radius = "10 mm"
centres = [[1, 1, 1], ["-11 mm", 0, 0]]
velocity = ["1 m/s", 0, 0]
[[grains]]
name = "right"
material = "rubber"
radius = "10 mm"
centres = [["11 mm", 0, 0]]
velocity = ["-1 m/s", 0, 0]
[output]
interval = "1 ms"
)";

// A spring between two bodies that come at 2 m/s is deepest a quarter of a period after they meet,
// at 1 ms; that depth is 2 m/s over the angular frequency.
TEST_F(RunRecord, NamesPairPlaceAndTimeOfTheDeepestOverlap) {
  test::write_bytes(folder_ / "case.toml", std::string(kCollision));
  const Outcome outcome = outcome_of({"run", scenario(), "--out", out()});
  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;

  const auto json = report();
  const auto deepest = json["deepest_overlap"];
  const double largest = json["largest_overlap_ratio"];
  const double frequency = 2.0 / (0.01 * largest);
  EXPECT_EQ(deepest["of"], nlohmann::json({"grains.left grain 1", "grains.right grain 0"}));
  EXPECT_GT(largest, 0.05);
  EXPECT_LE(deepest["ratio"], largest);
  EXPECT_GT(deepest["ratio"], largest / 1.01);  // the nearest that is told
  EXPECT_NEAR(deepest["depth_m"], 0.01 * double(deepest["ratio"]), 1e-12);
  for (const double x : deepest["place_m"]) EXPECT_NEAR(x, 0.0, 1e-12);
  const double step = json["timing"]["time_step_s"];
  EXPECT_GT(deepest["time_s"], 1e-3 + std::asin(1.0 / 1.01) / frequency - 2.0 * step);
  EXPECT_LT(deepest["time_s"], 1e-3 + 0.5 * std::numbers::pi / frequency + 2.0 * step);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("above 5 %, of grains.left grain 1 with grains.right "
                                           "grain 0 by "),
                                 HasSubstr(" s: too deep for a contact")));
}

TEST_F(RunRecord, HasNoDeepestOverlapWhereNoneIsDeep) {
  outcome_of({"run", scenario(), "--out", out(), "--set", "materials.gravel.young_modulus=1 GPa"});

  EXPECT_LT(report()["largest_overlap_ratio"], 0.05);
  EXPECT_FALSE(report().contains("deepest_overlap"));
}

}  // namespace
}  // namespace plekton::apps::run_record_test
