// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/output_folder.hpp"

#include "dynamics/output/file.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace plekton::apps::output_folder_test {
namespace {

using dynamics::OutputError;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(OutputFolderLock, KeepsOthersOutUntilItIsGone) {
  const test::TemporaryFolder folder;
  std::optional<OutputFolderLock> first(std::in_place, folder.path());
  EXPECT_EQ(first->warning(), "");
  EXPECT_THAT([&] { OutputFolderLock second(folder.path()); },
              ThrowsMessage<OutputError>(HasSubstr("another run writes to this folder")));
  first.reset();

  EXPECT_NO_THROW(OutputFolderLock{folder.path()});
}

TEST(OutputFolderLock, LeavesFoldersThatAreNotThereToWhoeverMakesThem) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "file", "");

  EXPECT_NO_THROW(OutputFolderLock{folder / "none"});
  EXPECT_NO_THROW(OutputFolderLock{folder / "file" / "below"});
}

TEST(OutputFolderLock, RefusesAFolderThatItCannotOpen) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory_symlink("loop", folder / "loop");

  EXPECT_THAT([&] { OutputFolderLock lock(folder / "loop"); },
              ThrowsMessage<OutputError>(HasSubstr("loop: cannot open the folder")));
  EXPECT_THROW(OutputFolderLock{folder / std::string(300, 'a')}, OutputError);
}

}  // namespace
}  // namespace plekton::apps::output_folder_test
