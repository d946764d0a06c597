// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/sync.hpp"

#include "dynamics/output/file.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plekton::dynamics::sync_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Sync, TakesFilesAndFoldersAndLeavesThemAsTheyAre) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "a.csv", "1\n");
  sync_file(folder / "a.csv");
  sync_folder(folder.path());
  sync_folder("");

  EXPECT_EQ(test::bytes_of(folder / "a.csv"), "1\n");
}

TEST(Sync, TellsOfWhatIsNotThere) {
  const test::TemporaryFolder folder;

  EXPECT_THAT([&] { sync_file(folder / "none.csv"); },
              ThrowsMessage<OutputError>(HasSubstr("none.csv: cannot make sure")));
  EXPECT_THROW(sync_folder(folder / "none"), OutputError);
}

TEST(Sync, HasNothingToDoForFilesThatGoNowhere) {
  EXPECT_NO_THROW(sync_file(std::filesystem::path(kNowhere) / "energy.csv"));
  EXPECT_NO_THROW(sync_folder(std::filesystem::path(kNowhere) / "checkpoints"));
}

}  // namespace
}  // namespace plekton::dynamics::sync_test
