// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/term_parts.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

namespace plekton::contact::structure::term_parts_test {
namespace {

/// Terms of which only the pairs of cells that have them matter.
struct Terms {
  std::vector<PairTerm> all;
  std::vector<Holder> holders;
  std::vector<std::uint32_t> acting;

  void add(std::initializer_list<Holder> having) {
    PairTerm term{};
    term.first_holder = static_cast<std::uint32_t>(holders.size());
    term.holder_count = static_cast<std::uint32_t>(having.size());
    holders.insert(holders.end(), having);
    acting.push_back(static_cast<std::uint32_t>(all.size()));
    all.push_back(term);
  }
  TermsInRange in_range() const { return {acting, all, holders}; }
};

std::vector<std::uint32_t> places(const TermParts& parts, std::size_t part) {
  return {parts.places(part).begin(), parts.places(part).end()};
}
using Places = std::vector<std::uint32_t>;

TEST(TermParts, ArePairsThatShareATermNumberedByTheirLowest) {
  Terms terms;
  for (const std::uint32_t pair : {1u, 2u, 4u, 5u, 6u}) terms.add({{pair, {}}});
  terms.add({{2, {}}, {5, {}}});
  terms.add({{4, {}}, {6, {}}});
  TermParts parts;
  parts.find(terms.in_range(), 8);
  ASSERT_EQ(parts.count(), 3u);
  const std::vector<std::int32_t> expected{-1, 0, 1, -1, 2, 1, 2, -1};
  for (std::uint32_t pair = 0; pair < expected.size(); ++pair)
    EXPECT_EQ(parts.part_of(pair), expected[pair]) << pair;
  EXPECT_EQ(places(parts, 0), Places{0});
  EXPECT_EQ(places(parts, 1), (Places{1, 3, 5}));
  EXPECT_EQ(places(parts, 2), (Places{2, 4, 6}));
}

TEST(TermParts, GivePlacesAmongTermsInRangeAndNotAmongAll) {
  Terms terms;
  for (const std::uint32_t pair : {0u, 1u, 2u}) terms.add({{pair, {}}});
  terms.acting = {0, 2};
  TermParts parts;
  parts.find(terms.in_range(), 3);
  ASSERT_EQ(parts.count(), 2u);
  EXPECT_EQ(parts.part_of(1), TermParts::kNone);
  EXPECT_EQ(places(parts, 1), Places{1});
}

TEST(TermParts, TurnPairsWhoseFirstCellIsAcrossFromThatOfTheLowest) {
  Terms terms;
  for (const std::uint32_t pair : {0u, 1u, 2u}) terms.add({{pair, {}}});
  terms.add({{0, {}}, {1, Sides(true)}});
  terms.add({{1, {}}, {2, Sides(true)}});
  TermParts parts;
  parts.find(terms.in_range(), 3);
  ASSERT_EQ(parts.count(), 1u);
  EXPECT_FALSE(parts.sides_of(0).are_crossed());
  EXPECT_TRUE(parts.sides_of(1).are_crossed());
  EXPECT_FALSE(parts.sides_of(2).are_crossed());
}

TEST(TermParts, OfNothingAreNone) {
  Terms terms;
  TermParts parts;
  EXPECT_EQ(parts.count(), 0u);
  parts.find(terms.in_range(), 2);
  EXPECT_EQ(parts.count(), 0u);
  EXPECT_EQ(parts.part_of(1), TermParts::kNone);
}

}  // namespace
}  // namespace plekton::contact::structure::term_parts_test
