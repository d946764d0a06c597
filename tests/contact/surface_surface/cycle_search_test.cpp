// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/cycle_search.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace plekton::contact::structure::cycle_search_test {
namespace {

constexpr double kLeastLife = 1e-15;

/// Pairs of cells in a row, each joined to the next.
struct Row {
  std::vector<PairTerm> terms;
  std::vector<Holder> holders;
  std::vector<std::uint32_t> acting;

  void add(double overlap, std::int32_t weight, std::initializer_list<std::uint32_t> pairs) {
    PairTerm term{};
    term.overlap = overlap;
    term.weight = weight;
    term.is_of_cells = pairs.size() == 1;
    term.first_holder = static_cast<std::uint32_t>(holders.size());
    term.holder_count = static_cast<std::uint32_t>(pairs.size());
    for (const std::uint32_t pair : pairs) holders.push_back({pair, {}});
    acting.push_back(static_cast<std::uint32_t>(terms.size()));
    terms.push_back(term);
  }
  explicit Row(std::uint32_t first, std::uint32_t count, bool is_closed) {
    grow(first, count, is_closed);
  }
  void grow(std::uint32_t first, std::uint32_t count, bool is_closed) {
    for (std::uint32_t i = 0; i < count; ++i) add(0.3 + 0.01 * i, 1, {first + i});
    for (std::uint32_t i = 0; i + 1 < count; ++i)
      add(0.2 - 0.01 * i, -1, {first + i, first + i + 1});
    if (is_closed) add(0.1, -1, {first, first + count - 1});
  }
};

class CycleSearchTest : public ::testing::Test {
 protected:
  /// Lowest pair of each part that is found.
  std::vector<std::uint32_t> find(const Row& row, std::uint32_t pair_count, int threads = 1) {
    geometry::ThreadPool pool(threads);
    const TermsInRange terms{row.acting, row.terms, row.holders};
    parts_.find(terms, pair_count);
    std::vector<std::uint32_t> lowest;
    for (const std::uint32_t part : search_.find(terms, parts_, true, kLeastLife, pool)) {
      std::uint32_t pair = 0;
      while (parts_.part_of(pair) != static_cast<std::int32_t>(part)) ++pair;
      lowest.push_back(pair);
    }
    return lowest;
  }

 private:
  TermParts parts_;
  CycleSearch search_;
};
using Lowest = std::vector<std::uint32_t>;

TEST_F(CycleSearchTest, FindsNothingWherePiecesMerge) {
  EXPECT_EQ(find(Row(0, 5, false), 5), Lowest());
}

TEST_F(CycleSearchTest, FindsThePartThatClosesARing) {
  Row row(0, 5, false);
  row.grow(5, 4, true);
  EXPECT_EQ(find(row, 9), Lowest{5});
}

/// As of a closed chain of four bars whose opposite corners meet.
TEST_F(CycleSearchTest, FindsTheCycleOfTwoPairsThatAreJoinedTwice) {
  Row row(0, 2, true);
  ASSERT_EQ(row.acting.size(), 4u);
  EXPECT_EQ(find(row, 2), Lowest{0});
}

TEST_F(CycleSearchTest, FindsACycleThatIsFilledAtAHigherLevel) {
  Row row(0, 4, true);
  row.add(0.05, 1, {0, 1, 2, 3});
  EXPECT_EQ(find(row, 4), Lowest{0});
}

TEST_F(CycleSearchTest, FindsACycleThatIsFilledALittleHigher) {
  Row row(0, 4, true);
  row.add(0.1 - 1e-14, 1, {0, 1, 2, 3});
  EXPECT_EQ(find(row, 4), Lowest{0});
}

TEST_F(CycleSearchTest, TakesWhatRoundingTearsApartAsOneLevel) {
  Row row(0, 4, true);
  row.add(0.1 * (1.0 - 1e-15), 1, {0, 1, 2, 3});
  EXPECT_EQ(find(row, 4), Lowest());
}

/// So it is not on what else there is that the levels of a part depend.
TEST_F(CycleSearchTest, TakesNoLevelsOfAnotherPartForThoseOfThisOne) {
  Row row(0, 4, true);
  row.add(0.1 - 1.8e-15, 1, {0, 1, 2, 3});
  ASSERT_EQ(find(row, 6), Lowest{0});
  row.grow(4, 2, false);
  row.terms.back().overlap = 0.1 - 0.9e-15;  // within a level of both
  EXPECT_EQ(find(row, 6), Lowest{0});
}

TEST_F(CycleSearchTest, FindsTheSameOfTermsInAnyOrderByAnyNumberOfThreads) {
  Row row(0, 6, true);
  for (std::uint32_t part = 1; part < 40; ++part) row.grow(6 * part, 6, part % 3 == 0);
  Lowest expected;
  for (std::uint32_t part = 0; part < 40; part += 3) expected.push_back(6 * part);
  EXPECT_EQ(find(row, 240), expected);
  for (PairTerm& term : row.terms)
    if (!term.is_of_cells) term.overlap = 0.25 - term.overlap;  // other terms join first
  EXPECT_EQ(find(row, 240, 4), expected);
}

}  // namespace
}  // namespace plekton::contact::structure::cycle_search_test
