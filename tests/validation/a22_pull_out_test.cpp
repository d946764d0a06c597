// SPDX-License-Identifier: GPL-3.0-or-later
// A22: a membrane, then a grid of the same lattice, is pulled out of a bed of 1368 grains between
// two plates that press with 20 kPa. The pull over 2 sigma A, A what is still in the bed, is at
// most tan(phi) where grains slide on a membrane; grains that interlock with a grid hold it better.
// Three beds, by chance, show the scatter.
#include "apps/validation/pull_out_bed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace plekton::test::a22_pull_out_test {
namespace {

using namespace apps::pull_out;

constexpr std::array<std::uint64_t, 3> kSeeds{3, 4, 5};

/// Over the beds.
struct Mean {
  double value = 0.0;
  double deviation = 0.0;
};

Mean mean_pull(Kind kind) {
  std::array<double, kSeeds.size()> means{};
  Mean mean;
  for (std::size_t i = 0; i < kSeeds.size(); ++i) {
    const PullOut pull = pulled_out(kind, kSeeds[i]);
    EXPECT_EQ(pull.grains, 1368U);
    EXPECT_NEAR(pull.pressure, kPressure, 0.05 * kPressure);
    if (kind == Kind::membrane) {
      EXPECT_GT(pull.mean, 0.18);
      EXPECT_LT(pull.mean, kFriction);
      EXPECT_LT(pull.largest, 1.02 * kFriction);
    }
    std::printf("pull-out of a %s, bed %d: mean %.3f, largest %.3f of 2 sigma A, sigma %.2f kPa\n",
                kind == Kind::membrane ? "membrane" : "grid", static_cast<int>(kSeeds[i]),
                pull.mean, pull.largest, 1e-3 * pull.pressure);
    means[i] = pull.mean;
    mean.value += pull.mean / static_cast<double>(kSeeds.size());
  }
  for (const double of : means)
    mean.deviation += (of - mean.value) * (of - mean.value) / (kSeeds.size() - 1.0);
  mean.deviation = std::sqrt(mean.deviation);
  std::printf("mean %.3f, standard deviation %.3f\n", mean.value, mean.deviation);
  return mean;
}

TEST(A22PullOut, AMembraneSlidesAndAGridInterlocks) {
  const Mean membrane = mean_pull(Kind::membrane);
  const Mean grid = mean_pull(Kind::grid);

  EXPECT_GT(grid.value, 0.35);
  EXPECT_LT(grid.value, 0.65);
  EXPECT_GT(grid.value - membrane.value, 2.0 * std::max(grid.deviation, membrane.deviation));
}

}  // namespace
}  // namespace plekton::test::a22_pull_out_test
