// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/tracking/reused_list.hpp"

#include <gmock/gmock.h>

#include <vector>

namespace plekton::contact::reused_list_test {
namespace {

using testing::ElementsAre;

std::vector<int> held_by(const ReusedList<int>& list) {
  return {list.begin(), list.end()};
}

TEST(ReusedList, HoldsWhatWasAddedSinceItWasCleared) {
  ReusedList<int> list;
  for (int i = 0; i < 1000; ++i) list.add() = i;
  const int* const room = list.data();

  list.clear();
  EXPECT_EQ(list.size(), 0U);
  for (const int thing : {7, 8, 9}) list.add() = thing;

  EXPECT_THAT(held_by(list), ElementsAre(7, 8, 9));
  EXPECT_EQ(list.data(), room);
}

TEST(ReusedList, KeepsWhatItHoldsAsItGrows) {
  ReusedList<int> list;
  for (int i = 0; i < 1000; ++i) list.add() = i;

  for (std::size_t i = 0; i < list.size(); ++i) EXPECT_EQ(list[i], static_cast<int>(i));
}

TEST(ReusedList, ShrinksToTheFirst) {
  ReusedList<int> list;
  for (const int thing : {7, 8, 9}) list.add() = thing;

  list.shrink(1);

  EXPECT_THAT(held_by(list), ElementsAre(7));
}

}  // namespace
}  // namespace plekton::contact::reused_list_test
