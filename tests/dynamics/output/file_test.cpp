// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/file.hpp"

#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cerrno>

namespace plekton::dynamics::file_test {
namespace {

using test::bytes_of;
using test::TemporaryFolder;
using test::write_bytes;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

TEST(OutputFile, AppearsOnlyWhenCommitted) {
  const TemporaryFolder folder;
  {
    OutputFile file(folder / "a.txt");
    file.write("one ");
    EXPECT_THAT(folder.names(), ElementsAre("a.txt.part"));
    file.write("two");

    file.commit();
  }

  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
  EXPECT_EQ(bytes_of(folder / "a.txt"), "one two");
}

TEST(OutputFile, LeavesNothingButTheOldFileWithoutCommit) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.txt", "old");

  {
    OutputFile file(folder / "a.txt");
    file.write("new");
  }

  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
  EXPECT_EQ(bytes_of(folder / "a.txt"), "old");
}

TEST(OutputFile, ReplacesAnOldFile) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.txt", "old and longer");

  OutputFile file(folder / "a.txt");
  file.write("new");
  file.commit();

  EXPECT_EQ(bytes_of(folder / "a.txt"), "new");
}

TEST(OutputFile, ForgetsThePartFileOfAnInterruptedRun) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.txt.part", "rest of a run that was killed");

  OutputFile file(folder / "a.txt");
  file.write("new");
  file.commit();

  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
  EXPECT_EQ(bytes_of(folder / "a.txt"), "new");
}

TEST(OutputFile, FollowsNoLinkInThePlaceOfItsPartFile) {
  const TemporaryFolder folder;
  write_bytes(folder / "victim", "precious");
  std::filesystem::create_symlink(folder / "victim", folder / "a.txt.part");
  std::filesystem::create_symlink(folder / "nowhere", folder / "b.txt.part");

  for (const std::string name : {"a.txt", "b.txt"}) {
    EXPECT_THAT([&] { OutputFile file(folder / name); },
                ThrowsMessage<OutputError>(AllOf(HasSubstr(name + ".part: cannot create: "),
                                                 HasSubstr("a link has this name; remove it"))));
  }
  EXPECT_EQ(bytes_of(folder / "victim"), "precious");
  EXPECT_THAT(folder.names(), ElementsAre("a.txt.part", "b.txt.part", "victim"));
}

TEST(OutputFile, WritesIntoNoOtherFileThatSharesThePartFile) {
  const TemporaryFolder folder;
  write_bytes(folder / "victim", "precious");
  std::filesystem::create_hard_link(folder / "victim", folder / "a.txt.part");

  OutputFile file(folder / "a.txt");
  file.write("new");
  file.commit();

  EXPECT_EQ(bytes_of(folder / "victim"), "precious");
  EXPECT_EQ(bytes_of(folder / "a.txt"), "new");
}

TEST(CheckedFile, SaysThatTheDiskIsFull) {
  // A device that takes no byte.
  CheckedFile file("/dev/full", CheckedFile::Mode::append);

  EXPECT_THAT([&] { file.write("text"); },
              ThrowsMessage<OutputError>(AllOf(HasSubstr("/dev/full: cannot write"),
                                               HasSubstr("No space left on device"),
                                               HasSubstr("free some space"))));
}

TEST(OutputFile, TakesNoNameAwayFromADevice) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink(folder / "pipe", folder / "link");

  for (const std::string name : {"pipe", "link"})
    EXPECT_THAT([&] { OutputFile file(folder / name); },
                ThrowsMessage<OutputError>(HasSubstr(name + ": is a device, pipe or socket")));
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
  EXPECT_THAT(folder.names(), ElementsAre("link", "pipe"));
}

TEST(OutputFile, LeavesNoFileWhenTheDiskFillsUpWithinAWrite) {
  const TemporaryFolder folder;
  const std::string block(1000, 'x');
  int reason = 0;

  try {
    const test::FileSizeLimit limit(2500);
    OutputFile file(folder / "a.txt");
    for (int i = 0; i < 3; ++i) file.write(block);
    file.commit();
  } catch (const OutputError& error) {
    reason = error.reason();
  }

  EXPECT_EQ(reason, EFBIG);
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(OutputFile, SaysThatItsFolderIsMissing) {
  const TemporaryFolder folder;

  const auto open = [&] { OutputFile file(folder / "missing" / "a.txt"); };

  EXPECT_THAT(open, ThrowsMessage<OutputError>(AllOf(HasSubstr("missing/a.txt.part: cannot create"),
                                                     HasSubstr("No such file"),
                                                     HasSubstr("check that its folder"))));
}

TEST(OutputFile, LeavesNoPartFileWhenAFolderHasItsName) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "a.txt");

  const auto write = [&] { OutputFile(folder / "a.txt").commit(); };

  EXPECT_THAT(write, ThrowsMessage<OutputError>(HasSubstr("a folder has this name")));
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(CheckedFile, IsCutBackToTheLastWholeWriteAndCanGoOn) {
  const TemporaryFolder folder;
  CheckedFile file(folder / "a.txt", CheckedFile::Mode::create);
  file.write("123\n");
  bool failed = false;

  try {
    const test::FileSizeLimit limit(6);
    file.write("4567\n");
  } catch (const OutputError&) {
    failed = true;
  }

  EXPECT_TRUE(failed);
  EXPECT_EQ(bytes_of(folder / "a.txt"), "123\n");
  file.write("4567\n");
  EXPECT_EQ(bytes_of(folder / "a.txt"), "123\n4567\n");
}

TEST(EnsureOutputFolder, CreatesAFolderAndLeavesItEmpty) {
  const TemporaryFolder folder;

  ensure_output_folder(folder / "out/");
  ensure_output_folder(folder / "out");

  EXPECT_TRUE(std::filesystem::is_directory(folder / "out"));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "out"));
}

TEST(EnsureOutputFolder, RefusesAFile) {
  const TemporaryFolder folder;
  write_bytes(folder / "out", "text");

  EXPECT_THAT([&] { ensure_output_folder(folder / "out"); },
              ThrowsMessage<OutputError>(HasSubstr("out: is a file, not a folder; remove it")));
  EXPECT_EQ(bytes_of(folder / "out"), "text");
}

TEST(EnsureOutputFolder, RefusesAPlaceBelowAFile) {
  const TemporaryFolder folder;
  write_bytes(folder / "file", "text");

  EXPECT_THAT([&] { ensure_output_folder(folder / "file" / "out"); },
              ThrowsMessage<OutputError>(
                  AllOf(HasSubstr("file/out: cannot create the folder: Not a directory"),
                        HasSubstr("a part of the path is a file"))));
}

TEST(EnsureOutputFolder, NamesTheMissingParent) {
  const TemporaryFolder folder;

  EXPECT_THAT([&] { ensure_output_folder(folder / "missing" / "out"); },
              ThrowsMessage<OutputError>(AllOf(
                  HasSubstr("its parent " + (folder / "missing").string() + " does not exist"))));
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(EnsureOutputFolder, RefusesAnEmptyName) {
  EXPECT_THAT([] { ensure_output_folder(""); },
              ThrowsMessage<OutputError>(HasSubstr("has no name")));
}

TEST(EnsureOutputFolder, RefusesAFolderThatTakesNoFiles) {
  // /proc takes no files, not even from the administrator.
  EXPECT_THAT([] { ensure_output_folder("/proc"); },
              ThrowsMessage<OutputError>(HasSubstr("/proc: cannot write into the folder: ")));
}

TEST(EnsureOutputFolder, RemovesAFolderCreatedInVain) {
  const TemporaryFolder folder;
  int reason = 0;

  try {
    const test::FileSizeLimit limit(0);
    ensure_output_folder(folder / "out");
  } catch (const OutputError& error) {
    reason = error.reason();
  }

  EXPECT_EQ(reason, EFBIG);
  EXPECT_THAT(folder.names(), IsEmpty());
}

}  // namespace
}  // namespace plekton::dynamics::file_test
