// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/regular_file.hpp"

#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>

namespace plekton::geometry::regular_file_test {
namespace {

using test::TemporaryFolder;
using test::write_bytes;

std::string message_of(const std::filesystem::path& path) {
  try {
    read_regular_file(path, "a scenario (.toml)");
  } catch (const UnreadableFile& error) {
    return error.what();
  }
  return "read";
}

TEST(ReadRegularFile, HasEveryByteAlsoThroughALink) {
  const TemporaryFolder folder;
  std::string bytes;
  // More than a pipe or a page takes at once, with line ends and zeros.
  for (int i = 0; i < 200000; ++i) bytes += static_cast<char>(i % 251 - 120);
  write_bytes(folder / "file", bytes);
  write_bytes(folder / "empty", "");
  std::filesystem::create_symlink(folder / "file", folder / "link");

  EXPECT_EQ(read_regular_file(folder / "file", "bytes"), bytes);
  EXPECT_EQ(read_regular_file(folder / "link", "bytes"), bytes);
  EXPECT_EQ(read_regular_file(folder / "empty", "bytes"), "");
}

TEST(ReadRegularFile, RefusesWhatHasNoEndOrMayBlock) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", folder / "link");

  for (const std::filesystem::path& path :
       {folder.path(), folder / "pipe", folder / "link", std::filesystem::path("/dev/zero")})
    EXPECT_EQ(message_of(path),
              path.string() + ": not a file on a disk; expected a scenario (.toml)");
}

TEST(ReadRegularFile, RefusesWhatTheKernelMakesUpThoughItCallsItselfRegular) {
  for (const std::filesystem::path path : {"/proc/self/status", "/sys/devices/system/cpu/online"}) {
    if (!std::filesystem::exists(path)) continue;
    EXPECT_EQ(message_of(path),
              path.string() + ": not a file on a disk; expected a scenario (.toml)");
  }
}

TEST(ReadRegularFile, SaysWhetherThereIsNoFileOrItCannotBeRead) {
  const TemporaryFolder folder;
  write_bytes(folder / "file", "text");
  std::filesystem::create_symlink("loop", folder / "loop");
  const std::string no_file = ": no such file; check the path (it counts from the current folder)";

  EXPECT_EQ(message_of(folder / "none"), (folder / "none").string() + no_file);
  EXPECT_EQ(message_of(folder / "file/below"), (folder / "file/below").string() + no_file);
  EXPECT_EQ(message_of(folder / "loop"),
            (folder / "loop").string() + ": cannot be read; check its permissions")
      << "a link to itself";
}

TEST(ReadRegularFile, TakesNoMemoryForAFileThatIsLargerThanIt) {
  const TemporaryFolder folder;
  const auto memory = static_cast<std::uintmax_t>(::sysconf(_SC_PHYS_PAGES)) *
                      static_cast<std::uintmax_t>(::sysconf(_SC_PAGESIZE));
  write_bytes(folder / "file", "");
  std::error_code error;
  std::filesystem::resize_file(folder / "file", memory + 1, error);  // a hole, of no blocks
  if (error) GTEST_SKIP() << "this disk takes no file that is larger than the memory";

  EXPECT_EQ(message_of(folder / "file"),
            (folder / "file").string() + ": has " + std::to_string(memory + 1) +
                " bytes, more than this machine has memory (" + std::to_string(memory) +
                "); expected a scenario (.toml)");
}

}  // namespace
}  // namespace plekton::geometry::regular_file_test
