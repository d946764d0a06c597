// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/closest_word.hpp"

#include <gtest/gtest.h>

#include <array>

namespace plekton::apps::closest_word_test {
namespace {

constexpr std::array<std::string_view, 4> kWords = {"duration", "damping", "gravity", "time_step"};

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(edit_distance("", "abc"), 3.0);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3.0);
  EXPECT_EQ(edit_distance("gravtiy", "gravity"), 1.0);
  EXPECT_EQ(edit_distance("Gravity", "gravity"), 0.5);
  EXPECT_EQ(edit_distance("gravity", "gravity"), 0.0);
}

TEST(ClosestWord, IsTheOneWithASlipOfTheFinger) {
  EXPECT_EQ(closest_word("duratoin", kWords), "duration");
  EXPECT_EQ(closest_word("timestep", kWords), "time_step");
  EXPECT_EQ(closest_word("Damping", kWords), "damping");
}

TEST(ClosestWord, IsNoneIfNothingIsNear) {
  EXPECT_EQ(closest_word("colour", kWords), "");
  EXPECT_EQ(closest_word("", kWords), "");
  EXPECT_EQ(closest_word("x", kWords), "");
}

}  // namespace
}  // namespace plekton::apps::closest_word_test
