// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/orderless_sum.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace plekton::geometry::orderless_sum_test {
namespace {

__extension__ using Int128 = __int128;

std::vector<double> of_all_sizes(std::size_t count, double low, double high, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(random.signed_power(low, high));
  return numbers;
}

void shuffle(std::vector<double>& numbers, test::Random& random) {
  for (std::size_t i = numbers.size(); i > 1; --i)
    std::swap(numbers[i - 1], numbers[random.index(i)]);
}

template <int W>
OrderlessSum sum_of(std::vector<double> numbers) {
  numbers.resize((numbers.size() + W - 1) / W * W, 0.0);
  OrderlessSum sum;
  sum.add<W>(numbers.data(), numbers.size());
  return sum;
}

std::uint64_t bits(const OrderlessSum& sum) {
  return std::bit_cast<std::uint64_t>(sum.value());
}

TEST(OrderlessSum, HasTheSameBitsInAnyOrderAndAnyParts) {
  test::Random random(2);
  for (const double high : {-200.0, -3.0, 0.0, 20.0, 290.0}) {
    std::vector<double> numbers = of_all_sizes(3000, high - 40.0, high, 1);
    const std::uint64_t expected = bits(sum_of<1>(numbers));
    for (int trial = 0; trial < 50; ++trial) {
      shuffle(numbers, random);
      ASSERT_EQ(bits(sum_of<2>(numbers)), expected);
      ASSERT_EQ(bits(sum_of<4>(numbers)), expected);
      ASSERT_EQ(bits(sum_of<8>(numbers)), expected);
      OrderlessSum whole;  // parts with largest numbers of their own
      for (std::size_t i = 0; i < numbers.size();) {
        const std::size_t end = std::min(numbers.size(), i + 1 + random.index(400));
        whole += sum_of<4>({&numbers[i], &numbers[end - 1] + 1});
        i = end;
      }
      ASSERT_EQ(bits(whole), expected);
      OrderlessSum one_by_one;
      for (const double number : numbers) one_by_one.add(number);
      ASSERT_EQ(bits(one_by_one), expected);
    }
  }
}

/// Numbers from 1e-9 to 1e9 are whole multiples of 2^-83, and n of them add up to less than 2^127
/// of these.
TEST(OrderlessSum, IsAsNearToTheExactSumAsItSays) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const std::vector<double> numbers = of_all_sizes(1000, -9.0, 9.0, seed);
    Int128 exact = 0;
    double largest = 0.0;
    for (const double number : numbers) {
      int exponent = 0;
      const auto mantissa =
          static_cast<std::int64_t>(std::ldexp(std::frexp(number, &exponent), 53));
      exact += static_cast<Int128>(mantissa) << (exponent - 53 + 83);
      largest = std::max(largest, std::abs(number));
    }
    const double sum = sum_of<8>(numbers).value();
    // What rounds the exact one here, and three terms of the sum, each below n times the largest.
    const double expected = std::ldexp(static_cast<double>(exact), -83);
    const double rounding =
        4.0 * 0x1p-53 * std::abs(expected) + 1000.0 * 0x1p-52 * 0x1p-32 * largest;
    EXPECT_NEAR(sum, expected, 1000.0 * 0x1p-64 * largest + rounding) << seed;
  }
}

TEST(OrderlessSum, LosesNothingWhereLargeNumbersCancel) {
  OrderlessSum sum;
  for (const double number : {1e15, 0.375, -1e15, 2.0 * 0x1p-20}) sum.add(number);
  EXPECT_EQ(sum.value(), 0.375 + 2.0 * 0x1p-20);
}

TEST(OrderlessSum, OfNothingOrZerosIsZero) {
  EXPECT_EQ(OrderlessSum().value(), 0.0);
  EXPECT_EQ(sum_of<4>({0.0, -0.0, 0.0}).value(), 0.0);
}

TEST(OrderlessSum, KnowsVerySmallAndVeryLargeNumbers) {
  EXPECT_EQ(sum_of<1>({0x1p-1000, 0x1p-1001}).value(), 1.5 * 0x1p-1000);
  EXPECT_EQ(sum_of<1>({0x1p990, 0x1p989}).value(), 1.5 * 0x1p990);
}

TEST(OrderlessSum, IsNoNumberWhereOneIsNotFiniteOrTooLarge) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  for (const double bad : {kInfinite, -kInfinite, std::nan(""), 0x1p991}) {
    EXPECT_TRUE(std::isnan(sum_of<4>({1.0, bad, 2.0}).value())) << bad;
    OrderlessSum sum = sum_of<1>({bad});
    sum += sum_of<1>({1.0});
    EXPECT_TRUE(std::isnan(sum.value())) << bad;
  }
}

}  // namespace
}  // namespace plekton::geometry::orderless_sum_test
