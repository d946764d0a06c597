// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/clearances.hpp"

#include "geometry/base/types.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace plekton::contact::structure::clearances_test {
namespace {

using geometry::Vec3;

constexpr double kRange = 0.01;

std::vector<std::size_t> due(const Clearances& clearances) {
  std::vector<std::size_t> pairs;
  clearances.for_each_due([&](std::size_t pair) { pairs.push_back(pair); });
  return pairs;
}

TEST(Clearances, AskForALookAtEveryNewPair) {
  Clearances clearances;

  clearances.reset(3, 0.0);

  EXPECT_EQ(due(clearances), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(Clearances, LeaveAPairAloneUntilItsNodesMayHaveMet) {
  Clearances clearances;
  clearances.reset(1, 1.0);
  clearances.set(0, 0.2);

  clearances.move(0.099);
  EXPECT_TRUE(due(clearances).empty());
  clearances.move(0.0011);
  EXPECT_EQ(due(clearances).size(), 1U);
}

/// Far from the origin, where steps are rounded most.
TEST(Clearances, NeverMissAPairThatComesIntoRange) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const Vec3 origin(1e3, -1e3, 1e3);
  std::vector<Vec3> x;
  for (int i = 0; i < 40; ++i) x.push_back(origin + 0.2 * Vec3(u(random), u(random), u(random)));
  const auto gap = [&](std::size_t pair) {
    return (x[pair] - x[x.size() - 1 - pair]).norm() - kRange;
  };
  Clearances clearances;
  clearances.reset(x.size() / 2, 1001.0);
  std::size_t looks = 0, in_range = 0;

  for (int step = 0; step < 5000; ++step) {
    const auto pairs = due(clearances);
    for (const std::size_t pair : pairs) clearances.set(pair, gap(pair));
    for (std::size_t pair = 0; pair < x.size() / 2; ++pair) {
      if (!(gap(pair) < 0.0)) continue;
      ++in_range;
      EXPECT_TRUE(std::binary_search(pairs.begin(), pairs.end(), pair)) << step;
    }
    looks += pairs.size();
    double way = 0.0;
    for (Vec3& point : x) {
      const Vec3 drift = 1e-3 * Vec3(u(random), u(random), u(random)) - 3e-4 * (point - origin);
      way = std::max(way, drift.norm());
      point += drift;
    }
    clearances.move(way);
  }

  EXPECT_GT(in_range, 0U);
  EXPECT_LT(looks, 5000U * x.size() / 4);
}

}  // namespace
}  // namespace plekton::contact::structure::clearances_test
