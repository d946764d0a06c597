// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/counting/spanning_forest.hpp"

#include "tests/support/random_complex.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace plekton::contact::spanning_forest_test {
namespace {

using namespace test;

/// The links from a vertex to the root of its tree.
std::vector<std::uint32_t> way_up(const SpanningForest& forest, std::uint32_t vertex) {
  std::vector<std::uint32_t> way;
  for (; forest.parent(vertex).link != SpanningForest::kNone; vertex = forest.parent(vertex).vertex)
    way.push_back(forest.parent(vertex).link);
  return way;
}

/// The links of the tree between the ends of a link; of none if they are in different trees.
std::vector<std::uint32_t> cycle_of(const SpanningForest& forest, const Link& link) {
  std::vector<std::uint32_t> a = way_up(forest, link.a), b = way_up(forest, link.b);
  while (!a.empty() && !b.empty() && a.back() == b.back()) {
    a.pop_back();
    b.pop_back();
  }
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(SpanningForest, LeavesOutOfEachCycleALinkThatResistsAtLeastHalfAsMuchAsTheOthers) {
  Random random(1);
  SpanningForest forest;
  std::size_t left_out = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const auto n = static_cast<std::uint32_t>(random.integer(2, 12));
    const auto links = random_links(random, n, random.integer(1, 40), 12.0);

    forest.grow(n, links);
    forest.hang(links);

    ASSERT_EQ(forest.downwards().size(), n);
    for (const std::uint32_t closing : forest.closing_links()) {
      for (const std::uint32_t link : cycle_of(forest, links[closing])) {
        ASSERT_NE(link, closing);
        ASSERT_LE(links[link].resistance, 2.0 * links[closing].resistance);
      }
      ++left_out;
    }
    const auto roots = static_cast<std::size_t>(
        std::count_if(forest.downwards().begin(), forest.downwards().end(),
                      [&](std::uint32_t vertex) { return way_up(forest, vertex).empty(); }));
    ASSERT_EQ(links.size() - forest.closing_links().size(), n - roots);
  }
  EXPECT_GT(left_out, 1000U);
}

TEST(SpanningForest, HasParentsBeforeWhatHangsOnThem) {
  Random random(2);
  const auto links = random_links(random, 12, 30, 3.0);
  SpanningForest forest;
  forest.grow(12, links);
  forest.hang(links);
  const auto order = forest.downwards();
  const auto place = [&](std::uint32_t vertex) {
    return std::find(order.begin(), order.end(), vertex);
  };
  for (const std::uint32_t vertex : order) {
    if (way_up(forest, vertex).empty()) continue;
    EXPECT_LT(place(forest.parent(vertex).vertex), place(vertex));
  }
}

TEST(SpanningForest, PutsALoopInNeitherList) {
  const std::vector<Link> links{{1, 1, 2.0}, {1, 0, 1.0}};
  SpanningForest forest;
  forest.grow(2, links);

  EXPECT_TRUE(forest.closing_links().empty());
}

}  // namespace
}  // namespace plekton::contact::spanning_forest_test
