// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/time_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace plekton::dynamics::time_table_test {
namespace {

using testing::HasSubstr;

/// 0 up to 1 s, then up to 4 at 3 s, then down to 2 at 4 s.
TimeTable table() {
  return TimeTable({{1.0, 0.0}, {3.0, 4.0}, {4.0, 2.0}});
}

std::string problems_of(const std::vector<TimeTable::Row>& rows) {
  try {
    const TimeTable made(rows);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(TimeTable, IsStraightBetweenItsRowsAndConstantOutside) {
  EXPECT_EQ(table().at(-5.0), 0.0);
  EXPECT_EQ(table().at(1.0), 0.0);
  EXPECT_EQ(table().at(1.5), 1.0);
  EXPECT_EQ(table().at(3.0), 4.0);
  EXPECT_EQ(table().at(3.25), 3.5);
  EXPECT_EQ(table().at(4.0), 2.0);
  EXPECT_EQ(table().at(100.0), 2.0);
}

TEST(TimeTable, KnowsItsIntegralFromTimeZero) {
  EXPECT_EQ(table().integral(0.0), 0.0);
  EXPECT_EQ(table().integral(2.0), 1.0);
  EXPECT_EQ(table().integral(3.0), 4.0);
  EXPECT_EQ(table().integral(4.0), 7.0);
  EXPECT_EQ(table().integral(6.0), 11.0);
  const TimeTable early({{-2.0, 1.0}, {2.0, 5.0}});
  EXPECT_EQ(early.integral(0.0), 0.0);
  EXPECT_EQ(early.integral(-2.0), -4.0);
  EXPECT_EQ(early.integral(-4.0), -6.0);
  EXPECT_EQ(early.integral(1.0), 3.5);
}

TEST(TimeTable, KnowsItsLargestValueAndSlopeBetweenTwoTimes) {
  EXPECT_EQ(table().largest({0.0, 1.5}), 1.0);
  EXPECT_EQ(table().largest({2.0, 3.5}), 4.0);
  EXPECT_EQ(table().largest({3.5, 9.0}), 3.0);
  EXPECT_EQ(table().largest({5.0, 9.0}), 2.0);
  EXPECT_EQ(TimeTable({{0.0, -3.0}, {1.0, 1.0}}).largest({-1.0, 1.0}), 3.0);
  EXPECT_EQ(table().largest_slope({0.0, 0.5}), 0.0);
  EXPECT_EQ(table().largest_slope({0.0, 1.5}), 2.0);
  EXPECT_EQ(TimeTable({{0.0, 0.0}, {1.0, 1.0}, {2.0, -5.0}}).largest_slope({0.2, 0.8}), 1.0);
  EXPECT_EQ(TimeTable({{0.0, 0.0}, {1.0, 1.0}, {2.0, -5.0}}).largest_slope({0.2, 1.0}), 6.0);
  EXPECT_EQ(table().largest_slope({4.5, 9.0}), 0.0);
  EXPECT_EQ(table().from(10.0).largest({10.0, 11.5}), 1.0);
  EXPECT_EQ(table().from(10.0).largest_slope({10.0, 10.5}), 0.0);
  EXPECT_EQ(TimeTable().largest({3.0, 4.0}), 1.0);
}

TEST(TimeTable, KnowsItsSlopeRightAfterATime) {
  EXPECT_EQ(table().slope(0.0), 0.0);
  EXPECT_EQ(table().slope(1.0), 2.0);
  EXPECT_EQ(table().slope(3.0), -2.0);
  EXPECT_EQ(table().slope(4.0), 0.0);
  EXPECT_EQ(table().largest_slope(), 2.0);
  EXPECT_EQ(table().largest(), 4.0);
}

TEST(TimeTable, KnowsItsLowestValue) {
  EXPECT_EQ(TimeTable({{0.0, 2.0}, {1.0, -3.0}, {2.0, 0.0}}).lowest(), -3.0);
  EXPECT_EQ(TimeTable().lowest(), 1.0);
}

TEST(TimeTable, MayBeOneNumberForEver) {
  EXPECT_EQ(TimeTable(3.0).at(-1.0), 3.0);
  EXPECT_EQ(TimeTable(3.0).at(1e9), 3.0);
  EXPECT_EQ(TimeTable(3.0).integral(2.0), 6.0);
  EXPECT_EQ(TimeTable().at(1.0), 1.0);
}

TEST(TimeTable, MayCountFromALaterStart) {
  const TimeTable later = table().from(10.0);

  EXPECT_EQ(later.start(), 10.0);
  for (const double time : {-1.0, 0.0, 1.5, 2.75, 4.0}) {
    EXPECT_EQ(later.at(10.0 + time), table().at(time)) << time;
    EXPECT_EQ(later.slope(10.0 + time), table().slope(time)) << time;
    EXPECT_EQ(later.integral(10.0 + time), table().integral(time)) << time;
  }
  EXPECT_EQ(later.largest(), table().largest());
}

TEST(TimeTable, RefusesRowsWithoutAnOrderInTime) {
  EXPECT_THAT(problems_of({{0.0, 1.0}, {2.0, 1.0}, {2.0, 3.0}}),
              HasSubstr("row 2 is at 2 s, not after 2 s of the row before"));
  EXPECT_THAT(problems_of({}), HasSubstr("has no rows"));
  EXPECT_THAT(problems_of({{0.0, std::numeric_limits<double>::quiet_NaN()}}),
              HasSubstr("row 0 (0 s, nan) is not finite"));
}

TEST(TimeTable, IsAsGoodAsNewAfterItWasMovedFrom) {
  TimeTable from = table().from(10.0);
  const TimeTable to = std::move(from);
  TimeTable assigned = table();
  TimeTable again(3.0);
  again = std::move(assigned);

  EXPECT_EQ(to.at(11.5), table().at(1.5));
  EXPECT_EQ(to.start(), 10.0);
  EXPECT_EQ(again.integral(3.0), table().integral(3.0));
  for (const TimeTable* const moved : {&from, &assigned}) {
    EXPECT_EQ(moved->at(-1.0), 1.0);
    EXPECT_EQ(moved->at(5.0), 1.0);
    EXPECT_EQ(moved->integral(2.0), 2.0);
    EXPECT_EQ(moved->slope(1.0), 0.0);
    EXPECT_EQ(moved->largest(), 1.0);
    EXPECT_EQ(moved->largest_slope(), 0.0);
    EXPECT_EQ(moved->start(), 0.0);
    ASSERT_EQ(moved->rows().size(), 1U);
    EXPECT_EQ(moved->rows()[0].value, 1.0);
  }
}

}  // namespace
}  // namespace plekton::dynamics::time_table_test
