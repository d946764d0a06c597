// SPDX-License-Identifier: GPL-3.0-or-later
// A run with checkpoints by the clock writes what it writes without, and goes on after a kill.
#include "apps/run/clock_checkpoints.hpp"

#include "apps/run/checkpoints.hpp"
#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/apps/run/frequent_outputs.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <string>
#include <thread>
#include <vector>

namespace plekton::apps::clock_checkpoints_test {
namespace {

namespace fs = std::filesystem;
using namespace test::frequent_outputs;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ClockCheckpointFiles : public testing::Test {
 protected:
  void write(std::int64_t step, CheckpointKind kind = CheckpointKind::by_clock) const {
    write_run_checkpoint(folder_.path(), step, {}, kind);
  }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const fs::path& file : checkpoints_of(folder_.path())) names.push_back(file.stem());
    return names;
  }

  test::TemporaryFolder folder_;
};

TEST_F(ClockCheckpointFiles, ReplaceEachOther) {
  ClockCheckpoints clock(folder_.path(), 60.0);
  for (const std::int64_t step : {16, 32, 48}) {
    write(step);
    clock.written(step);
  }

  EXPECT_THAT(names(), ElementsAre("step_000000000048_clock"));
}

TEST_F(ClockCheckpointFiles, AreReplacedByOneThatStaysAlsoOfTheSameStep) {
  ClockCheckpoints clock(folder_.path(), 60.0);
  write(16);
  clock.written(16);
  write(20, CheckpointKind::stays);
  clock.replaced();
  write(32);
  clock.written(32);
  write(32, CheckpointKind::stays);
  clock.replaced();

  EXPECT_THAT(names(), ElementsAre("step_000000000020", "step_000000000032"));
}

TEST_F(ClockCheckpointFiles, OfARunThatWasKilledAreReplacedToo) {
  for (const std::int64_t step : {16, 32}) write(step);
  ClockCheckpoints clock(folder_.path(), std::nullopt);
  write(40, CheckpointKind::stays);
  clock.replaced();

  EXPECT_THAT(names(), ElementsAre("step_000000000040"));
}

TEST_F(ClockCheckpointFiles, ThatComeAfterTheOneThatARunGoesOnFromAreRemoved) {
  for (const std::int64_t step : {16, 32, 48}) write(step, CheckpointKind::stays);
  write(32);
  remove_checkpoints_after(folder_.path(), 32);

  EXPECT_THAT(names(),
              ElementsAre("step_000000000016", "step_000000000032", "step_000000000032_clock"));
}

TEST_F(ClockCheckpointFiles, AreDueAfterTheIntervalAndNotAgainAtOnce) {
  using namespace std::chrono_literals;
  ClockCheckpoints clock(folder_.path(), 0.02);
  std::this_thread::sleep_for(25ms);
  EXPECT_TRUE(clock.is_due());
  clock.written(16);

  EXPECT_FALSE(ClockCheckpoints(folder_.path(), 1e300).is_due());
  EXPECT_FALSE(ClockCheckpoints(folder_.path(), std::nullopt).is_due());
  EXPECT_FALSE(ClockCheckpoints(folder_.path(), 3600.0).is_due());
}

class ClockCheckpointRuns : public testing::Test {
 protected:
  /// Frames and checkpoints by simulated time, and by the clock after every 16 steps, if asked.
  std::vector<std::string> arguments_with(const std::string& name, bool by_clock) const {
    std::vector<std::string> all = arguments(out(name));
    for (std::string& argument : all)
      if (argument.starts_with("output.checkpoint_interval"))
        argument = "output.checkpoint_interval=\"7 ms\"";
    if (by_clock) all.insert(all.end(), {"--set", "output.checkpoint_wall_interval=\"1 us\""});
    return all;
  }
  std::string out(const std::string& name) const { return (folder_ / name).string(); }
  /// But for the texts of checkpoints, which have the keys of their scenario.
  std::map<std::string, std::string> results(const std::string& name) const {
    auto contents = contents_of(out(name));
    for (auto& [file, bytes] : contents)
      if (file.ends_with(".h5") || file.ends_with(".toml")) bytes.clear();
    return contents;
  }
  nlohmann::json report(const std::string& name) const {
    return nlohmann::json::parse(test::bytes_of(folder_ / (name + "/run.json")));
  }

  test::TemporaryFolder folder_;
};

TEST_F(ClockCheckpointRuns, WriteWhatTheyWriteWithoutThem) {
  ASSERT_EQ(Program(arguments_with("plain", false)).wait().exit_code, kDone);
  ASSERT_EQ(Program(arguments_with("clock", true)).wait().exit_code, kDone);

  EXPECT_THAT(differences(results("clock"), results("plain")), IsEmpty());
  EXPECT_EQ(report("clock")["states"], report("plain")["states"]);
  EXPECT_EQ(report("clock")["energy"], report("plain")["energy"]);
}

TEST_F(ClockCheckpointRuns, GoOnFromOneAfterAKill) {
  ASSERT_EQ(Program(arguments_with("plain", false)).wait().exit_code, kDone);
  Program killed(arguments_with("killed", true));
  ASSERT_TRUE(Program::appears(folder_ / "killed/frames/grains_00010.vtp"));
  killed.send(SIGKILL);
  killed.wait();
  ASSERT_FALSE(checkpoints_of(out("killed")).empty());
  const Outcome resumed = Program({"run", "--resume", out("killed"), "--quiet"}).wait();

  ASSERT_EQ(resumed.exit_code, kDone) << resumed.err;
  EXPECT_THAT(differences(results("killed"), results("plain")), IsEmpty());
}

/// As a kill between the last step and the checkpoint at the end leaves it.
TEST_F(ClockCheckpointRuns, EndWithTheCheckpointThatStaysAlsoFromOneOfTheLastStep) {
  ASSERT_EQ(Program(arguments_with("plain", false)).wait().exit_code, kDone);
  const auto whole = results("plain");
  const fs::path last = checkpoints_of(out("plain")).back();
  fs::rename(last, last.parent_path() / (last.stem().string() + "_clock.h5"));
  const Outcome resumed = Program({"run", "--resume", out("plain"), "--quiet"}).wait();

  ASSERT_EQ(resumed.exit_code, kDone) << resumed.err;
  EXPECT_THAT(differences(results("plain"), whole), IsEmpty());
}

TEST_F(ClockCheckpointRuns, RefuseAnIntervalThatIsNone) {
  std::vector<std::string> all = arguments_with("none", true);
  all.back() = "output.checkpoint_wall_interval=\"0 s\"";
  const Outcome outcome = Program(all).wait();

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("output.checkpoint_wall_interval"));
  EXPECT_THAT(outcome.err, HasSubstr("above 0"));
}

}  // namespace
}  // namespace plekton::apps::clock_checkpoints_test
