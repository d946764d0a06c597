// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/decide.hpp"

#include "tests/support/exact_pair.hpp"
#include "tests/support/simplex_families.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace plekton::geometry::closest::decide_test {
namespace {

using test::kPairFamilies;
using test::kPairFamilyNames;
using test::SimplexFamilies;

bool are_equal(const Decision& p, const Decision& q) {
  return p.witness_features == q.witness_features && p.relation == q.relation;
}

/// Whether rational foot points of the features are one point.
bool meet(Corners a, Corners b, const WitnessFeatures& features) {
  const auto points = test::ExactPair(a, b).feet(features.a, features.b);
  return points && test::dot(points->separation, points->separation).is_zero();
}

/// Calls check(a, b, name of the family) on some pairs of every family.
template <std::size_t kCountA, std::size_t kCountB, class Check>
void on_all_families(std::uint64_t seed, int per_family, const Check& check) {
  SimplexFamilies<kCountA, kCountB> families(seed);
  for (std::size_t f = 0; f < kPairFamilies.size(); ++f) {
    for (int trial = 0; trial < per_family; ++trial) {
      const auto [a, b] = families.draw(kPairFamilies[f]);
      check(a, b, kPairFamilyNames[f]);
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}

template <std::size_t kCountA, std::size_t kCountB>
void expect_the_same_whatever_the_guess(std::uint64_t seed) {
  int unique = 0;
  on_all_families<kCountA, kCountB>(seed, 100, [&](const auto& a, const auto& b, auto name) {
    const Decision expected = enumerate(a, b);
    for (unsigned of_a = 1; of_a < 1U << kCountA; ++of_a) {
      for (unsigned of_b = 1; of_b < 1U << kCountB; ++of_b) {
        ASSERT_TRUE(are_equal(decide(a, b, {of_a, of_b}), expected))
            << name << ", guess " << of_a << ' ' << of_b;
        unique += certify(a, b, {of_a, of_b}) == Verdict::unique;
      }
    }
  });
  EXPECT_GT(unique, 500) << "guesses that are taken were among them";
}

TEST(Decide, AnswersTheSameWhateverTheGuess) {
  expect_the_same_whatever_the_guess<2, 2>(1);
  expect_the_same_whatever_the_guess<2, 3>(2);
  expect_the_same_whatever_the_guess<3, 3>(3);
}

template <std::size_t kCount>
void expect_the_same_for_a_point(std::uint64_t seed) {
  on_all_families<1, kCount>(seed, 200, [](const auto& a, const auto& b, auto name) {
    const Decision expected = enumerate(a, b);
    for (unsigned guess = 1; guess < 1U << kCount; ++guess)
      ASSERT_TRUE(are_equal(decide_for_point(a, b, guess), expected)) << name << ' ' << guess;
  });
}

TEST(DecideForPoint, AnswersTheSameWhateverTheGuess) {
  expect_the_same_for_a_point<2>(4);
  expect_the_same_for_a_point<3>(5);
}

template <std::size_t kCountA, std::size_t kCountB>
void expect_the_relation_and_the_reverse(std::uint64_t seed) {
  std::array<int, 2> counts{};
  on_all_families<kCountA, kCountB>(seed, 150, [&](const auto& a, const auto& b, auto name) {
    const Decision found = enumerate(a, b);
    const bool meets = meet(a, b, found.witness_features);

    ASSERT_EQ(found.relation, meets ? Relation::touching_or_crossing : Relation::apart) << name;
    const Decision reversed = enumerate(b, a);
    ASSERT_EQ(reversed.witness_features,
              (WitnessFeatures{found.witness_features.b, found.witness_features.a}))
        << name;
    ASSERT_EQ(reversed.relation, found.relation) << name;
    ++counts[meets ? 1 : 0];
  });
  EXPECT_GT(counts[0], 100);
  EXPECT_GT(counts[1], 10);
}

TEST(Enumerate, SaysWhetherCoresMeetAndTheSameFromBothSides) {
  expect_the_relation_and_the_reverse<1, 3>(6);
  expect_the_relation_and_the_reverse<2, 2>(7);
  expect_the_relation_and_the_reverse<3, 2>(8);
  expect_the_relation_and_the_reverse<3, 3>(9);
}

TEST(Decide, CountsAPairThatIsEnumeratedOnceFromEitherSide) {
  const std::array<Vec3, 2> a{Vec3(0, 0, 0), Vec3(1, 0, 0)};
  const std::array<Vec3, 2> crossed{Vec3(0.5, -1, 1), Vec3(0.5, 1, 1)};
  const std::array<Vec3, 2> parallel{Vec3(0, 0, 1), Vec3(1, 0, 1)};
  const auto count_of = [](Corners x, Corners y, const WitnessFeatures& guess) {
    const std::uint64_t before = closest_counters().enumerated;
    decide(x, y, guess);
    return closest_counters().enumerated - before;
  };

  EXPECT_EQ(count_of(a, crossed, {3U, 3U}), 0u) << "unique";
  EXPECT_EQ(count_of(a, crossed, {1U, 3U}), 1u) << "a wrong guess";
  EXPECT_EQ(count_of(a, parallel, {1U, 1U}), 1u) << "a tie";
  EXPECT_EQ(count_of(parallel, a, {1U, 1U}), 1u) << "with its lower side last";
}

}  // namespace
}  // namespace plekton::geometry::closest::decide_test
