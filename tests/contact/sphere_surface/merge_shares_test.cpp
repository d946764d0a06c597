// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/merge_shares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace plekton::contact::merge_shares_test {
namespace {

std::vector<double> shares_of(MergeShares& merging) {
  const auto shares = merging.shares();
  return {shares.begin(), shares.end()};
}

TEST(MergeShares, AreAllOfItForAMinimumAlone) {
  MergeShares merging;
  const std::vector<double> minima = {0.3, 0.5};
  merging.begin(minima);
  EXPECT_EQ(shares_of(merging), (std::vector<double>{1.0, 1.0}));
}

TEST(MergeShares, AreByTheDepthOfEachBelowThePass) {
  MergeShares merging;
  const std::vector<double> minima = {0.25, 0.5};
  merging.begin(minima);
  merging.join(0, 1, 0.75);
  EXPECT_EQ(shares_of(merging), (std::vector<double>{0.5 / 0.75, 0.25 / 0.75}));
}

TEST(MergeShares, GrowTogetherInPartsThatHaveJoined) {
  MergeShares merging;
  const std::vector<double> minima = {0.25, 0.5, 0.125};
  merging.begin(minima);
  const std::uint32_t part = merging.join(0, 1, 0.75);  // has 3/4 here, and 1 at the next pass
  merging.join(2, part, 1.0);                           // 7/8 and 1
  const auto shares = shares_of(merging);
  EXPECT_DOUBLE_EQ(shares[2], 0.875 / 1.875);
  EXPECT_DOUBLE_EQ(shares[0], 1.0 / 1.875 * (0.5 / 0.75));
  EXPECT_DOUBLE_EQ(shares[1], 1.0 / 1.875 * (0.25 / 0.75));
}

TEST(MergeShares, BeginWithNothingForAMinimumThatIsAsFarAsItsPass) {
  MergeShares merging;
  const std::vector<double> minima = {0.25, 0.5};
  merging.begin(minima);
  merging.join(0, 1, 0.5);
  EXPECT_EQ(shares_of(merging), (std::vector<double>{1.0, 0.0}));
}

TEST(MergeShares, AreHalvesWhereBothPartsAreAtTheSamePlace) {
  MergeShares merging;
  const std::vector<double> minima = {0.5, 0.5};
  merging.begin(minima);
  merging.join(0, 1, 0.5);
  EXPECT_EQ(shares_of(merging), (std::vector<double>{0.5, 0.5}));
}

// Random trees of passes: never negative, 1 in sum, and as Lipschitz as the quotients that they are:
// by 2 / (the least sum at a pass) of the largest change of a distance, for each pass on the way.
TEST(MergeShares, AddUpToOneAndChangeInProportionToTheDistances) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 500; ++trial) {
    const std::size_t count = 2 + random() % 12;
    std::vector<double> minima(count), passes(count - 1);
    for (double& d : minima) d = 0.4 * uniform(random);
    for (double& d : passes) d = 0.5 + 0.5 * uniform(random);
    std::sort(passes.begin(), passes.end());
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    std::shuffle(order.begin(), order.end(), random);
    const auto find = [&](double shift) {
      MergeShares merging;
      std::vector<double> moved = minima;
      for (std::size_t i = 0; i < count; ++i) moved[i] += (i % 2 == 0 ? shift : -shift);
      merging.begin(moved);
      std::uint32_t part = order[0];
      for (std::size_t i = 1; i < count; ++i) part = merging.join(part, order[i], passes[i - 1]);
      return shares_of(merging);
    };
    constexpr double kShift = 1e-6;
    const auto before = find(0.0);
    const auto after = find(kShift);
    EXPECT_NEAR(std::accumulate(before.begin(), before.end(), 0.0), 1.0, 1e-14);
    // Every part has at least 0.1 at its pass, both together 0.2.
    const double slope = 2.0 / 0.2 * static_cast<double>(count) * static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_GE(before[i], 0.0);
      EXPECT_LE(std::abs(after[i] - before[i]), slope * kShift);
    }
  }
}

}  // namespace
}  // namespace plekton::contact::merge_shares_test
