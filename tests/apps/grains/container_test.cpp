// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/grains/container.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace plekton::apps::container_test {
namespace {

TEST(Container, OfACylinderHoldsBallsThatTouchItsSidesAndNoMore) {
  const Container container = container_of({Vec3::Zero(), Vec3(0.0, 0.0, 4.0), 2.0});

  EXPECT_TRUE(container.holds({1.0, 0.0, 2.0}, 1.0));
  EXPECT_FALSE(container.holds({1.01, 0.0, 2.0}, 1.0));
  EXPECT_TRUE(container.holds({0.0, 0.0, 1.0}, 1.0));
  EXPECT_FALSE(container.holds({0.0, 0.0, 0.99}, 1.0));
  EXPECT_FALSE(container.holds({0.0, 0.0, 3.01}, 1.0));
  EXPECT_DOUBLE_EQ(container.volume, 16.0 * std::numbers::pi);
  EXPECT_EQ(container.bounds.upper, Vec3(2.0, 2.0, 4.0));
}

TEST(Container, OfABoxIsTheBox) {
  const Container container = container_of(Box{Vec3::Zero(), {1.0, 2.0, 3.0}});

  EXPECT_EQ(container.volume, 6.0);
  EXPECT_EQ(container.bounds.upper, Vec3(1.0, 2.0, 3.0));
}

TEST(Container, OfASurfaceHoldsWhatItSaysIsInside) {
  Container container;
  container.is_inside = [](const Vec3& point) { return point[0] > 0.0; };

  EXPECT_TRUE(container.holds({1.0, 0.0, 0.0}, 5.0));
  EXPECT_FALSE(container.holds({-1.0, 0.0, 0.0}, 0.1));
}

}  // namespace
}  // namespace plekton::apps::container_test
