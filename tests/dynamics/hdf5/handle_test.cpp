// SPDX-License-Identifier: GPL-3.0-or-later
// The library is for one thread at a time; what uses it here is not.
#include "dynamics/hdf5/handle.hpp"

#include "dynamics/hdf5/hdf5_reader.hpp"
#include "dynamics/hdf5/hdf5_writer.hpp"
#include "dynamics/hdf5/trial.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace plekton::dynamics::hdf5::handle_test {
namespace {

/// Writes and reads files with numbers of one's own.
/// @returns how many were read as they were written
int files_that_come_back(int count, double first) {
  int right = 0;
  for (int i = 0; i < count; ++i) {
    std::vector<double> numbers(100, first + i);
    Hdf5Writer writer;
    for (const char* const name : {"/a/x", "/a/y", "/b/c/z"}) writer.numbers(name, numbers, 4);
    writer.attribute("/a", "text", std::to_string(i));
    const Hdf5Reader reader(writer.bytes(), "it");
    right += reader.numbers("/b/c/z").values == numbers && reader.names_in("/a").size() == 2 &&
             reader.text_attribute("/a", "text") == std::to_string(i);
  }
  return right;
}

TEST(LibraryUse, IsOfOneThreadAtATime) {
  constexpr int kFiles = 50;
  std::vector<int> right(4, 0);
  {
    std::vector<std::jthread> threads;
    for (std::size_t k = 0; k < right.size(); ++k)
      threads.emplace_back(
          [&right, k] { right[k] = files_that_come_back(kFiles, 1e3 * static_cast<double>(k)); });
  }

  EXPECT_EQ(right, std::vector<int>(right.size(), kFiles));
}

TEST(Hdf5Reader, ReadsItsOwnFileWhileOthersAreOpen) {
  const auto bytes_with = [](double value) {
    Hdf5Writer writer;
    writer.number("/x", value);
    Hdf5Writer other;
    other.number("/x", -value);
    return writer.bytes();
  };
  const Hdf5Reader one(bytes_with(1.0), "one"), two(bytes_with(2.0), "two");

  EXPECT_EQ(one.numbers("/x").values, std::vector<double>{1.0});
  EXPECT_EQ(two.numbers("/x").values, std::vector<double>{2.0});
}

TEST(LibraryUse, MayBeWithinAnother) {
  const LibraryUse outer, inner;

  EXPECT_EQ(files_that_come_back(1, 0.0), 1);
}

/// A process is copied with whatever its other threads are at.
TEST(LibraryUse, IsThatOfACopyOfTheProcessWhileOtherThreadsUseIt) {
  constexpr unsigned kSeconds = 20;
  std::atomic<bool> goes_on = true;
  std::jthread other([&] {
    while (goes_on) files_that_come_back(1, 0.0);
  });
  int killed = 0;
  for (int i = 0; i < 20; ++i) {
    const auto use = [] { files_that_come_back(1, 1.0); };
    killed += try_out(use, kSeconds).was_killed;
  }
  goes_on = false;

  EXPECT_EQ(killed, 0);
}

}  // namespace
}  // namespace plekton::dynamics::hdf5::handle_test
