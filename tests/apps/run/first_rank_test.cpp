// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/first_rank.hpp"

#include "dynamics/output/csv_writer.hpp"
#include "dynamics/output/file.hpp"
#include "dynamics/output/pvd_series.hpp"
#include "tests/support/thread_ranks.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <stdexcept>
#include <string>

namespace plekton::apps::first_rank_test {
namespace {

TEST(FirstRank, AloneWritesIntoTheFolder) {
  EXPECT_EQ(folder_of_rank(nullptr, "out"), "out");
  test::ThreadRanks(3).run([](geometry::Ranks& ranks) {
    EXPECT_EQ(folder_of_rank(&ranks, "out") == "out", ranks.rank() == 0);
    EXPECT_EQ(is_first_rank(&ranks), ranks.rank() == 0);
  });
}

TEST(FirstRank, DoesAloneWhatIsDoneOnce) {
  std::atomic<int> done = 0, after = 0;
  test::ThreadRanks(3).run([&](geometry::Ranks& ranks) {
    by_first_rank(&ranks, [&] { ++done; });
    after += done;  // nobody goes on before it is done
  });
  EXPECT_EQ(done, 1);
  EXPECT_EQ(after, 3);
}

TEST(FirstRank, FailsWithItsMessageAndTheOthersFailToo) {
  std::atomic<int> failed = 0;
  test::ThreadRanks(3).run([&](geometry::Ranks& ranks) {
    try {
      by_first_rank(&ranks, [] { throw std::runtime_error("the folder is full"); });
    } catch (const std::runtime_error& error) {
      ++failed;
      EXPECT_EQ(std::string(error.what()) == "the folder is full", ranks.rank() == 0);
    }
  });
  EXPECT_EQ(failed, 3);
}

TEST(FirstRank, HearsOfASignalThatAnotherOneSawAfterTheSameStep) {
  std::atomic<int> sum = 0;
  test::ThreadRanks(3).run([&](geometry::Ranks& ranks) {
    int step = 0;
    const auto is_interrupted =
        asked_now_and_then(&ranks, [&] { return ranks.rank() == 2 && step > 20; });
    while (!is_interrupted()) ++step;
    sum += step;
  });
  EXPECT_EQ(sum % 3, 0);
  EXPECT_GT(sum, 3 * 20);
}

TEST(FirstRank, IsTheOnlyOneWhoseFilesGoAnywhere) {
  const std::filesystem::path nowhere(dynamics::kNowhere);
  EXPECT_TRUE(dynamics::goes_nowhere(nowhere / "frames" / "grains.vtp"));
  EXPECT_FALSE(dynamics::goes_nowhere("/dev/nullify/x"));
  EXPECT_FALSE(dynamics::goes_nowhere("out"));
  dynamics::ensure_output_folder(nowhere / "frames");
  const std::array columns{dynamics::CsvColumn{"x", "m"}};
  dynamics::CsvWriter rows(nowhere / "a.csv", columns);
  rows.add(std::array{1.0});
  rows.close();
  dynamics::PvdSeries series(nowhere / "grains.pvd");
  series.add({{0.0, nowhere / "frames" / "grains.vtp", "grains"}});
}

}  // namespace
}  // namespace plekton::apps::first_rank_test
