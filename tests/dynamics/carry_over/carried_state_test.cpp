// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/carry_over/carried_state.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

namespace plekton::dynamics::carried_state_test {
namespace {

using testing::ElementsAre;

geometry::StateArray array_of(std::vector<double> numbers, std::size_t columns) {
  geometry::StateArray array;
  array.columns = columns;
  array.numbers = std::move(numbers);
  return array;
}

TEST(CarriedState, PutsTheRowsOfAGroupWhereTheyAreNowAndTakesAllElseAsItWas) {
  geometry::StateTree before, now;
  before.arrays["nodes/position"] = array_of({1, 2, 3, 4, 5, 6}, 2);
  before.arrays["time"] = array_of({7}, 1);
  now.arrays["nodes/position"] = array_of({0, 0, -1, -1}, 2);
  now.arrays["time"] = array_of({0}, 1);
  const std::vector<std::int32_t> places{1, -1, 0};
  const std::array groups{KeptRows{"nodes/", places}};
  const geometry::StateTree state = carried_state(before, now, groups);
  EXPECT_THAT(std::get<std::vector<double>>(state.arrays.at("nodes/position").numbers),
              ElementsAre(5, 6, 1, 2));
  EXPECT_THAT(std::get<std::vector<double>>(state.arrays.at("time").numbers), ElementsAre(7));
}

TEST(CarriedState, LeavesNewRowsAsTheyAre) {
  geometry::StateTree before, now;
  before.arrays["planes/radius"] = array_of({1}, 1);
  now.arrays["planes/radius"] = array_of({8, 9}, 1);
  const std::vector<std::int32_t> places{1};
  const std::array groups{KeptRows{"planes/", places}};
  const geometry::StateTree state = carried_state(before, now, groups);
  EXPECT_THAT(std::get<std::vector<double>>(state.arrays.at("planes/radius").numbers),
              ElementsAre(8, 1));
}

}  // namespace
}  // namespace plekton::dynamics::carried_state_test
