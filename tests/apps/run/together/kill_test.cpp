// SPDX-License-Identifier: GPL-3.0-or-later
// A run that is killed at any moment leaves whole files, and goes on to the bytes of one that was
// not. PLEKTON_KILLS in the environment says how often (12 if it is not there).
#include "apps/run/checkpoints.hpp"
#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/apps/run/frequent_outputs.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

namespace plekton::apps::kill_test {
namespace {

namespace fs = std::filesystem;
using namespace test::frequent_outputs;
using Clock = std::chrono::steady_clock;

TEST(KilledRun, GoesOnToTheBytesOfOneThatWasNot) {
  const test::TemporaryFolder folder;
  const auto began = Clock::now();
  ASSERT_EQ(Program(arguments((folder / "whole").string())).wait().exit_code, kDone);
  const std::chrono::duration<double> whole_time = Clock::now() - began;
  const auto whole = contents_of(folder / "whole");

  const char* const asked = std::getenv("PLEKTON_KILLS");
  const int kills = asked == nullptr ? 12 : std::atoi(asked);
  test::Random random(17);
  int resumed = 0;
  for (int i = 0; i < kills; ++i) {
    const std::string out = (folder / "killed").string();
    fs::remove_all(out);
    Program program(arguments(out));
    std::this_thread::sleep_for(random.uniform(0.05, 1.0) * whole_time);
    program.send(SIGKILL);
    program.wait();
    expect_whole_files(out);
    if (checkpoints_of(out).empty()) continue;  // killed before the first: begins anew
    ++resumed;
    const Outcome outcome =
        Program({"run", "--resume", out, "--quiet", "--threads", std::to_string(1 + i % 2)}).wait();
    ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
    EXPECT_EQ(differences(contents_of(out), whole), std::vector<std::string>{}) << "kill " << i;
    if (HasFailure()) break;
  }
  RecordProperty("resumed", resumed);
  std::cout << resumed << " of " << kills << " had a checkpoint and went on\n";
  EXPECT_GT(resumed, 0);
}

TEST(KilledRun, LeavesNoLockBehind) {
  const test::TemporaryFolder folder;
  const std::string out = (folder / "out").string();
  Program program(arguments(out));
  ASSERT_TRUE(Program::appears(fs::path(out) / "frames" / "grains_00005.vtp"));
  const Outcome second = Program({"run", "--resume", out, "--quiet"}).wait();
  program.send(SIGKILL);
  program.wait();

  EXPECT_EQ(second.exit_code, kFailed) << second.err;
  EXPECT_EQ(Program({"run", "--resume", out, "--quiet"}).wait().exit_code, kDone);
}

TEST(InterruptedRun, WritesACheckpointAndSaysHowToGoOn) {
  const test::TemporaryFolder folder;
  const std::string out = (folder / "out").string();
  std::vector<std::string> all = arguments(out);
  std::erase(all, "--quiet");
  for (std::string& argument : all)
    if (argument.starts_with("output.checkpoint_interval")) argument = "output.hash_interval=100";
  Program program(all);
  ASSERT_TRUE(Program::appears(fs::path(out) / "frames" / "grains_00010.vtp"));
  program.send(SIGTERM);
  const Outcome outcome = program.wait();

  EXPECT_EQ(outcome.exit_code, kInterrupted);
  EXPECT_EQ(checkpoints_of(out).size(), 1U);
  EXPECT_NE(outcome.out.find("plekton run --resume " + out), std::string::npos) << outcome.out;
  EXPECT_EQ(Program({"run", "--resume", out, "--quiet"}).wait().exit_code, kDone);
}

}  // namespace
}  // namespace plekton::apps::kill_test
