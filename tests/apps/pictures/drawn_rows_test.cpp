// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/pictures/drawn_rows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace plekton::apps::drawn_rows_test {
namespace {

using testing::Contains;

TEST(DrawnRows, AreAllOfAShortCurve) {
  const std::vector<double> x = {3.0, 1.0, 2.0}, y = {0.0, 5.0, 5.0};

  EXPECT_THAT(drawn_rows(x, y, 8), testing::ElementsAre(0, 1, 2));
  EXPECT_TRUE(drawn_rows({}, {}, 8).empty());
}

TEST(DrawnRows, OfALongCurveHoldItsEndsAndItsPeaksOfBothAxesInOrder) {
  std::vector<double> x(10'001), y(x.size(), 0.0);
  std::iota(x.begin(), x.end(), 0.0);
  x[5'003] = 2e4;
  y[7'777] = 9.0;
  y[1'234] = -9.0;

  const auto rows = drawn_rows(x, y, 400);

  for (const std::size_t row : {0U, 1'234U, 5'003U, 7'777U, 10'000U})
    EXPECT_THAT(rows, Contains(row));
  EXPECT_LE(rows.size(), 402U);
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
  EXPECT_EQ(std::adjacent_find(rows.begin(), rows.end()), rows.end());
}

TEST(DrawnRows, KeepPeaksBesideWhatIsNoNumberAndGapsAsGaps) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> x(10'000), y(x.size(), 0.0);
  std::iota(x.begin(), x.end(), 0.0);
  y[5'000] = 9.0;
  y[5'001] = nan;
  std::fill(y.begin() + 2'000, y.begin() + 3'000, nan);

  const auto rows = drawn_rows(x, y, 400);

  EXPECT_THAT(rows, Contains(5'000U));
  EXPECT_TRUE(std::any_of(rows.begin(), rows.end(),
                          [&](std::size_t row) { return row > 2'000 && row < 3'000; }));
}

}  // namespace
}  // namespace plekton::apps::drawn_rows_test
