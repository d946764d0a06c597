// SPDX-License-Identifier: GPL-3.0-or-later
// What happens to a run's files when its disk is full, its folder goes, or nothing may be written
// any more: one message, exit 1, whole files, and the last checkpoint to go on from.
// Two runs into one folder: RunKeepsOutOfAFolderThatAnotherRunWritesTo (program_test),
// LeavesNoLockBehind (kill_test). A folder of an earlier run: RunRefusesAFolderThatHoldsResults,
// RunReplacesWhatAnEarlierRunLeft (program_test).
#include "apps/run/checkpoints.hpp"
#include "tests/apps/command_line/command_fixture.hpp"
#include "tests/apps/run/frequent_outputs.hpp"
#include "tests/support/mounted_folder.hpp"
#include "tests/support/parameter_name.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace plekton::apps::faults_test {
namespace {

using namespace test::frequent_outputs;
using testing::HasSubstr;

constexpr std::size_t kRoom = std::size_t{64} << 20U;  // bytes, enough for all of the run
constexpr const char* kNoMounts = "this user may not mount anything";

std::ptrdiff_t parts_in(const fs::path& folder) {
  return std::ranges::count_if(fs::recursive_directory_iterator(folder), [](const auto& entry) {
    return entry.path().extension() == ".part";
  });
}

void expect_no_parts(const fs::path& folder) {
  EXPECT_EQ(parts_in(folder), 0) << folder;
}

/// One line on standard error, that of the program.
void expect_one_message(const Outcome& outcome) {
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("plekton: ")) << outcome.err;
}

TEST(FullDisk, EndsARunWithOneMessageAndWholeFilesFromWhichItGoesOn) {
  const test::TemporaryFolder other;
  ASSERT_EQ(outcome_of(arguments((other / "whole").string())).exit_code, kDone);
  std::uintmax_t size = 0;
  for (const auto& entry : fs::recursive_directory_iterator(other / "whole"))
    if (entry.is_regular_file()) size += entry.file_size();
  const test::SmallDisk disk(size / 2);
  if (!disk.is_mounted()) GTEST_SKIP() << kNoMounts;

  const std::string out = (disk / "out").string();
  const Outcome full = outcome_of(arguments(out));

  EXPECT_EQ(full.exit_code, kFailed);
  EXPECT_THAT(full.err, HasSubstr("No space left on device"));
  expect_one_message(full);
  expect_whole_files(out);
  expect_no_parts(out);
  ASSERT_FALSE(checkpoints_of(out).empty());
  ASSERT_TRUE(disk.resize(kRoom));
  const Outcome resumed = outcome_of({"run", "--resume", out, "--quiet"});
  ASSERT_EQ(resumed.exit_code, kDone) << resumed.err;
  EXPECT_EQ(differences(contents_of(out), contents_of(other / "whole")),
            std::vector<std::string>{});
}

TEST(ReadOnlyFolder, EndsARunAtItsNextCheckpointWithOneMessage) {
  if (!test::has_own_mounts()) GTEST_SKIP() << kNoMounts;
  const test::TemporaryFolder folder;
  const std::string out = (folder / "out").string();
  std::vector<std::string> endless = arguments(out);
  endless.insert(endless.end(), {"--set", "simulation.duration=1000"});
  Program program(endless);
  ASSERT_TRUE(Program::appears(fs::path(out) / "frames/grains_00005.vtp"));

  const test::ReadOnlyFolder read_only(fs::path(out) / kCheckpointFolder);
  ASSERT_TRUE(read_only.is_read_only());
  const Outcome outcome = program.wait();

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("Read-only file system"));
  expect_one_message(outcome);
  expect_whole_files(out);
  // What was closed just before can neither be renamed nor be removed there.
  expect_no_parts(fs::path(out) / "frames");
  EXPECT_LE(parts_in(fs::path(out) / kCheckpointFolder), 1);
  EXPECT_FALSE(checkpoints_of(out).empty());
}

class RemovedFolder : public testing::TestWithParam<const char*> {};

TEST_P(RemovedFolder, EndsARunWithOneMessageAndIsNotMadeAgain) {
  const test::TemporaryFolder folder;
  const fs::path out = folder / "out";
  std::vector<std::string> endless = arguments(out.string());
  endless.insert(endless.end(), {"--set", "simulation.duration=1000", "--set", GetParam()});
  Program program(endless);
  ASSERT_TRUE(Program::appears(out / "grains.pvd"));

  fs::rename(out, folder / "gone");  // as removing does to its name, and at once
  const Outcome outcome = program.wait();

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err,
              testing::AnyOf(HasSubstr("No such file or directory"), HasSubstr("does not exist"),
                             HasSubstr("there is no such file")));
  EXPECT_THAT(outcome.err, HasSubstr(out.string()));
  expect_one_message(outcome);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"gone"});
  expect_whole_files(folder / "gone");
}

INSTANTIATE_TEST_SUITE_P(AtAFrameOrACheckpoint, RemovedFolder,
                         testing::Values("output.checkpoint_interval=1000", "output.interval=1000"),
                         test::name_of_parameter);

/// Names of bodies and reactions are in files, and no part of the names of files.
TEST_F(Command, RunWritesNowhereElseWhateverNamesAScenarioGives) {
  std::string text(kScenario);
  for (const std::string name : {"sheet", "gravel", "floor"}) {
    const std::string before = "name = \"" + name + "\"";
    text.replace(text.find(before), before.size(), "name = \"../../" + name + "<&>,'/\"");
  }
  text += "contact_list = true\ncheckpoint_interval = \"5 ms\"\n";
  text += "reactions = [{ kind = \"plane\", plane = \"../../floor<&>,'/\", name = \"/../r,1\" }]\n";
  test::write_bytes(folder_ / "case.toml", text);
  const std::vector<std::string> before = folder_.names();

  const Outcome outcome = outcome_of({"run", scenario(), "--out", out()});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  expect_complete_files();
  std::vector<std::string> expected = before;
  expected.emplace_back("out");
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(folder_.names(), expected);
  for (const auto& entry : fs::recursive_directory_iterator(out()))
    EXPECT_EQ(entry.path().filename().string().find_first_of("<&>,' "), std::string::npos);
  EXPECT_THAT(test::bytes_of(folder_ / "out/reactions.csv"), HasSubstr("\"/../r,1"));
}

}  // namespace
}  // namespace plekton::apps::faults_test
