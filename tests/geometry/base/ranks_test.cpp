// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/ranks.hpp"

#include "tests/support/thread_ranks.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <numeric>
#include <vector>

namespace plekton::geometry::ranks_test {
namespace {

TEST(Ranks, GiveEachRankARangeOfAboutEqualWork) {
  const std::vector<std::uint64_t> work = {5, 1, 1, 1, 4, 4, 2, 6};

  const std::vector<int> owners = Ranks::ranges_of_equal_work(work, 3);

  EXPECT_TRUE(std::is_sorted(owners.begin(), owners.end()));
  std::array<std::uint64_t, 3> sums{};
  for (std::size_t i = 0; i < work.size(); ++i)
    sums[static_cast<std::size_t>(owners[i])] += work[i];
  // A third each, and at each end of a range at most half of the largest piece more or less.
  for (const std::uint64_t sum : sums) EXPECT_NEAR(static_cast<double>(sum), 24.0 / 3, 6.0);
}

TEST(Ranks, FindAnOwnerForEveryPieceWhereThereAreFewerThanRanks) {
  for (const int owner : Ranks::ranges_of_equal_work(std::vector<std::uint64_t>{0, 0}, 5))
    EXPECT_EQ(owner, 0);
  const std::vector<int> one = Ranks::ranges_of_equal_work(std::vector<std::uint64_t>{7}, 5);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_GE(one[0], 0);
  EXPECT_LT(one[0], 5);
  EXPECT_TRUE(Ranks::ranges_of_equal_work({}, 2).empty());
}

TEST(Ranks, ShareGivesAllWhatTheOwnersHave) {
  constexpr std::size_t kPieces = 20;
  std::atomic<int> right = 0;
  test::ThreadRanks(3).run([&](Ranks& ranks) {
    const auto owner = [](std::size_t i) { return static_cast<int>(i * i % 3); };
    std::vector<std::vector<char>> pieces;  // of odd sizes, some empty
    for (std::size_t i = 0; i < kPieces; ++i)
      pieces.emplace_back(i % 5, owner(i) == ranks.rank() ? static_cast<char>(i) : '?');
    std::vector<std::byte> room;

    share(ranks, room, [&](const auto& visit) {
      for (std::size_t i = 0; i < kPieces; ++i)
        visit(owner(i), std::as_writable_bytes(std::span(pieces[i])));
    });

    for (std::size_t i = 0; i < kPieces; ++i)
      right += pieces[i] == std::vector<char>(i % 5, static_cast<char>(i));
  });
  EXPECT_EQ(right, 3 * static_cast<int>(kPieces));
}

TEST(Ranks, KnowWhetherAnyOfThemSaysYes) {
  for (const int yes : {-1, 0, 2}) {
    std::atomic<int> heard = 0;
    test::ThreadRanks(3).run(
        [&](Ranks& ranks) { heard += any_rank(ranks, ranks.rank() == yes) ? 1 : 0; });
    EXPECT_EQ(heard, yes < 0 ? 0 : 3);
  }
}

struct Letter {
  std::int64_t from;
  std::int64_t number;
  friend bool operator==(const Letter&, const Letter&) = default;
};

/// So many that no two ranks have as many, and one has none.
std::vector<Letter> letters_of(int rank) {
  std::vector<Letter> letters;
  for (std::int64_t n = 0; n < 7 * rank; ++n) letters.push_back({rank, n});
  return letters;
}

TEST(Ranks, TellAllWhatEachHas) {
  std::atomic<int> right = 0;
  test::ThreadRanks(3).run([&](Ranks& ranks) {
    const std::vector<Letter> own = letters_of(ranks.rank());
    const ThingsOfRanks<Letter> all = told_to_all(ranks, std::span<const Letter>(own));
    for (int rank = 0; rank < 3; ++rank)
      right += std::ranges::equal(all.of(rank), letters_of(rank)) ? 1 : 0;
    right +=
        told_by_each(ranks, std::int64_t{5} + ranks.rank()) == std::vector<std::int64_t>{5, 6, 7};
  });
  EXPECT_EQ(right, 3 * 4);
}

TEST(Ranks, DealOutEachThingToOneRankInTheOrderOfWhoHadIt) {
  const auto receiver = [](const Letter& letter) {
    return static_cast<int>((letter.number * letter.number + letter.from) % 3);
  };
  std::atomic<int> right = 0;
  std::atomic<std::size_t> received = 0;
  test::ThreadRanks(3).run([&](Ranks& ranks) {
    const std::vector<Letter> own = letters_of(ranks.rank());
    const ThingsOfRanks<Letter> here = dealt_out(ranks, std::span<const Letter>(own), receiver);
    for (int rank = 0; rank < 3; ++rank) {
      std::vector<Letter> expected = letters_of(rank);
      std::erase_if(expected, [&](const Letter& l) { return receiver(l) != ranks.rank(); });
      right += std::ranges::equal(here.of(rank), expected) ? 1 : 0;
    }
    received += here.things.size();
  });
  EXPECT_EQ(right, 9);
  EXPECT_EQ(received, 0U + 7U + 14U);
}

}  // namespace
}  // namespace plekton::geometry::ranks_test
