// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/copy_bits.hpp"

#include "geometry/base/lane_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <new>

namespace plekton::geometry::copy_bits_test {
namespace {

struct Mixed {
  double x;
  bool flag;
  int count;
  char last;
};

/// The bytes of a thing in memory that was full of something.
std::array<unsigned char, sizeof(Mixed)> bytes_in(unsigned char dirt) {
  alignas(Mixed) std::array<unsigned char, sizeof(Mixed)> memory;
  memory.fill(dirt);
  Mixed& mixed = *new (memory.data()) Mixed;
  mixed.x = 1.5;
  mixed.flag = true;
  mixed.count = 7;
  mixed.last = 'z';
  std::array<unsigned char, sizeof(Mixed)> bytes;
  copy_bits(mixed, bytes.data());
  return bytes;
}

TEST(CopyBits, LeavesOutBytesThatBelongToNoMember) {
#if !__has_builtin(__builtin_clear_padding)
  GTEST_SKIP() << "this compiler cannot tell them";
#endif
  EXPECT_EQ(bytes_in(0xff), bytes_in(0x00));
}

TEST(LaneRows, KeepThingsThatAreNoWholeNumberOfDoubles) {
  std::array<double, 8> numbers{};
  const LaneRows<4> rows(numbers.data());
  const std::array<int, 3> thing{1, -2, 3};

  rows.set(2, thing);

  EXPECT_EQ((rows.at<std::array<int, 3>>(2)), thing);
  EXPECT_EQ(std::count(numbers.begin(), numbers.end(), 0.0), 6);
}

}  // namespace
}  // namespace plekton::geometry::copy_bits_test
