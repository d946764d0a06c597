// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/ring_search.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace plekton::contact::structure::ring_search_test {
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
    for (const std::uint32_t pair : pairs) holders.push_back({pair, false});
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

TEST(RingSearch, FindsNothingWherePiecesMerge) {
  Row row(0, 5, false);
  RingSearch search;
  EXPECT_FALSE(search.find(row.acting, row.terms, row.holders, 5, kLeastLife));
}

TEST(RingSearch, FindsThePartThatClosesARing) {
  Row row(0, 5, false);
  row.grow(5, 4, true);
  RingSearch search;
  ASSERT_TRUE(search.find(row.acting, row.terms, row.holders, 9, kLeastLife));
  EXPECT_EQ(std::vector(search.pairs().begin(), search.pairs().end()),
            (std::vector<std::uint32_t>{5, 6, 7, 8}));
  EXPECT_TRUE(search.is_more(search.part_of(7)));
  EXPECT_FALSE(search.is_more(search.part_of(2)));
}

TEST(RingSearch, FindsARingThatIsFilledAtAHigherLevel) {
  Row row(0, 4, true);
  row.add(0.05, 1, {0, 1, 2, 3});
  RingSearch search;
  EXPECT_TRUE(search.find(row.acting, row.terms, row.holders, 4, kLeastLife));
}

TEST(RingSearch, FindsARingThatIsFilledALittleHigher) {
  Row row(0, 4, true);
  row.add(0.1 - 1e-14, 1, {0, 1, 2, 3});
  RingSearch search;
  EXPECT_TRUE(search.find(row.acting, row.terms, row.holders, 4, kLeastLife));
}

TEST(RingSearch, TakesWhatRoundingTearsApartAsOneLevel) {
  Row row(0, 4, true);
  row.add(0.1 * (1.0 - 1e-15), 1, {0, 1, 2, 3});
  RingSearch search;
  EXPECT_FALSE(search.find(row.acting, row.terms, row.holders, 4, kLeastLife));
}

}  // namespace
}  // namespace plekton::contact::structure::ring_search_test
