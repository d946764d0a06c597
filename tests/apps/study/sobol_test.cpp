// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/study/sobol.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace plekton::apps::sobol_test {
namespace {

/// The first points as Joe and Kuo print them in their notes on generating Sobol sequences (2008),
/// three dimensions.
TEST(SobolPoints, AreThoseOfJoeAndKuo) {
  const std::vector<std::vector<double>> expected = {{0, 0, 0},
                                                     {0.5, 0.5, 0.5},
                                                     {0.75, 0.25, 0.25},
                                                     {0.25, 0.75, 0.75},
                                                     {0.375, 0.375, 0.625},
                                                     {0.875, 0.875, 0.125},
                                                     {0.625, 0.125, 0.875},
                                                     {0.125, 0.625, 0.375}};

  EXPECT_EQ(sobol_points(8, 3), expected);
}

/// Of 2^m points each interval [i, i + 1) / 2^m holds exactly one in every coordinate.
TEST(SobolPoints, FillEveryCoordinateEvenly) {
  for (const std::size_t parameters : {1U, 2U, 21U, 200U}) {
    const auto points = sobol_points(64, parameters);
    for (std::size_t i = 0; i < parameters; ++i) {
      std::set<int> intervals;
      for (const auto& point : points)
        intervals.insert(static_cast<int>(std::floor(64 * point[i])));
      EXPECT_EQ(intervals.size(), 64U) << "coordinate " << i << " of " << parameters;
    }
  }
}

TEST(SobolPoints, BeginWithThoseOfAShorterSequence) {
  const auto points = sobol_points(100, 5);
  const auto fewer = sobol_points(37, 5);

  EXPECT_TRUE(std::equal(fewer.begin(), fewer.end(), points.begin()));
}

}  // namespace
}  // namespace plekton::apps::sobol_test
