// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/lexicographic.hpp"

#include <gtest/gtest.h>

namespace plekton::geometry::lexicographic_test {
namespace {

TEST(Lexicographic, IsByXThenYThenZ) {
  EXPECT_TRUE(lexicographically_less(Vec3(0, 9, 9), Vec3(1, 0, 0)));
  EXPECT_TRUE(lexicographically_less(Vec3(1, 0, 9), Vec3(1, 2, 0)));
  EXPECT_TRUE(lexicographically_less(Vec3(1, 2, -1), Vec3(1, 2, 0)));
  EXPECT_FALSE(lexicographically_less(Vec3(1, 2, 3), Vec3(1, 2, 3)));
  EXPECT_FALSE(lexicographically_less(Vec3(1, 0, 0), Vec3(0, 9, 9)));
}

}  // namespace
}  // namespace plekton::geometry::lexicographic_test
