// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/run_estimate.hpp"

#include "apps/scenario/scenario_reader.hpp"
#include "tests/apps/command_line/command_fixture.hpp"

namespace plekton::apps::run_estimate_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class RunEstimates : public Command {
 protected:
  RunEstimate estimate(const std::vector<std::string>& settings) const {
    const Scenario read = read_scenario(scenario(), settings);
    PreparedRun prepared = prepare_run(read);
    return estimate_run(read, prepared);
  }
};

TEST_F(RunEstimates, HoldStepsAndDiskOfTheRun) {
  const RunEstimate estimated = estimate({});
  ASSERT_EQ(outcome_of({"run", scenario(), "--out", out()}).exit_code, kDone);

  double bytes = 0.0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out()))
    if (entry.is_regular_file()) bytes += static_cast<double>(entry.file_size());
  EXPECT_GE(bytes, estimated.bytes.low);
  EXPECT_LE(bytes, estimated.bytes.high);
  EXPECT_EQ(report()["counts"]["frames"], estimated.frames);
  EXPECT_GT(estimated.timed_steps, 0);
  EXPECT_GT(estimated.wall_time.low, 0.0);
  EXPECT_GE(estimated.wall_time.high, kLaterCost * estimated.wall_time.low);
  const double steps = report()["timing"]["steps"];
  // A step that is chosen may grow, too, where what is fast slows down.
  EXPECT_GE(steps, 0.5 * estimated.steps.low);
  EXPECT_LE(steps, 1.01 * estimated.steps.high);
}

TEST_F(RunEstimates, TakeNoMoreStepsThanTheRunHas) {
  const RunEstimate estimated = estimate({"simulation.duration=1 us"});

  EXPECT_EQ(estimated.steps.low, 1.0);
  EXPECT_EQ(estimated.timed_steps, 1);
  EXPECT_EQ(estimated.frames, 2.0);
}

TEST_F(RunEstimates, SayHowTheyWereFound) {
  const std::vector<std::string> check = {"check", scenario()};
  EXPECT_THAT(outcome_of(check).out,
              AllOf(HasSubstr("\nwall time: "), HasSubstr(" steps timed now took "),
                    HasSubstr(" are not in it\n"), HasSubstr("\ndisk: ")));
}

TEST_F(RunEstimates, WarnOfARunThatDivergesAtOnce) {
  const RunEstimate estimated =
      estimate({"grains.gravel.angular_velocity=[1e8, 0, 0]", "simulation.time_step=2 us"});

  EXPECT_THAT(estimated.failure, HasSubstr("spins at 1e+08 rad/s"));
  EXPECT_THAT(text_of(estimated), testing::StartsWith("warning: it diverges within"));
}

}  // namespace
}  // namespace plekton::apps::run_estimate_test
