// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/pair_numbers.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace plekton::contact::pair_numbers_test {
namespace {

TEST(PairNumbers, AreReadInTheOrderOfThePairs) {
  PairNumbers numbers;
  numbers.add({1, 2}, 10);
  numbers.add({1, 5}, 11);
  numbers.add({3, 4}, 12);
  PairNumbers::Reader reader(numbers);
  EXPECT_EQ(reader.of({1, 2}), 10);
  EXPECT_EQ(reader.of({1, 4}), 0);
  EXPECT_EQ(reader.of({3, 4}), 12);
  EXPECT_EQ(reader.of({9, 10}), 0);
}

TEST(PairNumbers, TakeNewerOnesInPlaceOfTheirOwn) {
  PairNumbers numbers, newer;
  numbers.add({1, 2}, 10);
  numbers.add({3, 4}, 12);
  newer.add({0, 1}, 21);
  newer.add({3, 4}, 20);
  numbers.merge(std::move(newer));
  numbers.merge({});
  PairNumbers::Reader reader(numbers);
  EXPECT_EQ(reader.of({0, 1}), 21);
  EXPECT_EQ(reader.of({1, 2}), 10);
  EXPECT_EQ(reader.of({3, 4}), 20);
}

}  // namespace
}  // namespace plekton::contact::pair_numbers_test
