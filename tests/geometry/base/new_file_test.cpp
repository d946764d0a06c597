// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/new_file.hpp"

#include "tests/support/temporary_folder.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

namespace plekton::geometry::new_file_test {
namespace {

using test::bytes_of;
using test::TemporaryFolder;
using test::write_bytes;
using ::testing::ElementsAre;

/// What a call leaves in errno; 0 if it gives a file.
int error_of(const std::filesystem::path& path) {
  errno = 0;
  const int descriptor = create_new_file(path);
  if (descriptor < 0) return errno;
  ::close(descriptor);
  return 0;
}

bool write_all(int descriptor, std::string_view bytes) {
  return ::write(descriptor, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
}

TEST(PartOf, AddsAnEndingToTheWholeName) {
  EXPECT_EQ(part_of("a.vtp"), "a.vtp.part");
  EXPECT_EQ(part_of("run.2/frame"), "run.2/frame.part");
}

TEST(IsNoFile, TellsPipesAndDevicesAlsoBehindLinks) {
  const TemporaryFolder folder;
  write_bytes(folder / "file", "text");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink(folder / "pipe", folder / "to_pipe");
  std::filesystem::create_symlink(folder / "file", folder / "to_file");
  std::filesystem::create_symlink(folder / "nothing", folder / "to_nothing");

  for (const char* name : {"pipe", "to_pipe"}) EXPECT_TRUE(is_no_file(folder / name)) << name;
  EXPECT_TRUE(is_no_file("/dev/null"));
  for (const char* name : {"file", "to_file", "to_nothing", "nothing", "."})
    EXPECT_FALSE(is_no_file(folder / name)) << name;
}

TEST(CreateNewFile, SaysWhatHasTheNameAndLeavesItThere) {
  const TemporaryFolder folder;
  write_bytes(folder / "file", "precious");
  std::filesystem::create_symlink(folder / "file", folder / "link");
  std::filesystem::create_symlink(folder / "nothing", folder / "loose_link");
  std::filesystem::create_directory(folder / "folder");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);

  EXPECT_EQ(error_of(folder / "link"), ELOOP);
  EXPECT_EQ(error_of(folder / "loose_link"), ELOOP);
  EXPECT_EQ(error_of(folder / "folder"), EISDIR);
  EXPECT_EQ(error_of(folder / "pipe"), EEXIST);
  EXPECT_EQ(error_of(folder / "missing/file"), ENOENT);
  EXPECT_THAT(folder.names(), ElementsAre("file", "folder", "link", "loose_link", "pipe"));
  EXPECT_EQ(bytes_of(folder / "file"), "precious");
}

TEST(CreateNewFile, TakesTheNameOfAFileWithoutTouchingItsBytes) {
  const TemporaryFolder folder;
  write_bytes(folder / "file", "old and longer");
  std::ifstream reader(folder / "file");

  const int descriptor = create_new_file(folder / "file");

  ASSERT_GE(descriptor, 0);
  EXPECT_TRUE(write_all(descriptor, "new"));
  ::close(descriptor);
  EXPECT_EQ(bytes_of(folder / "file"), "new");
  const std::string old{std::istreambuf_iterator<char>(reader), std::istreambuf_iterator<char>()};
  EXPECT_EQ(old, "old and longer") << "who has it open still reads what was there";
}

TEST(CreateNewFile, WritesAtTheEndAfterACutAndClosesInProgramsItStarts) {
  const TemporaryFolder folder;
  const int descriptor = create_new_file(folder / "file");
  ASSERT_GE(descriptor, 0);

  EXPECT_TRUE(write_all(descriptor, "whole, half"));
  EXPECT_EQ(::ftruncate(descriptor, 6), 0);
  EXPECT_TRUE(write_all(descriptor, " whole"));
  const int flags = ::fcntl(descriptor, F_GETFD);
  ::close(descriptor);

  EXPECT_EQ(bytes_of(folder / "file"), "whole, whole") << "without a gap of zeros";
  EXPECT_NE(flags & FD_CLOEXEC, 0);
}

TEST(CreateNewFile, LeavesToTheUserWhoMayRead) {
  const TemporaryFolder folder;
  struct stat status {};

  const mode_t before = ::umask(0027);
  const int error = error_of(folder / "file");
  ::umask(before);

  ASSERT_EQ(error, 0);
  ASSERT_EQ(::stat((folder / "file").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

}  // namespace
}  // namespace plekton::geometry::new_file_test
