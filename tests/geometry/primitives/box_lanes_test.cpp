// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/primitives/box_lanes.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plekton::geometry::box_lanes_test {
namespace {

template <int W>
void expect_overlaps_by_definition() {
  test::Random random(9);
  for (int round = 0; round < 2000; ++round) {
    BoxLanes lanes;
    lanes.clear();
    // On a coarse grid, so that many boxes only touch.
    const auto corner = [&] { return Vec3((2.0 * random.in_cube(2.0)).array().round()); };
    const Vec3 least = corner();
    const Vec3 greatest = least + corner().cwiseAbs();
    const auto count = static_cast<std::size_t>(random.uniform(0.0, 8.99));
    unsigned expected = 0;
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Vec3 l = corner();
      const Vec3 g = l + corner().cwiseAbs();
      lanes.set(lane, l, g, static_cast<std::int32_t>(lane));
      if ((l.array() <= greatest.array()).all() && (least.array() <= g.array()).all())
        expected |= 1U << lane;
    }
    ASSERT_EQ(lanes.overlaps<W>(least, greatest), expected);
  }
}

TEST(BoxLanes, TellWhichBoxesOverlapOrTouchAnotherOne) {
  expect_overlaps_by_definition<2>();
  expect_overlaps_by_definition<4>();
  expect_overlaps_by_definition<8>();
}

TEST(BoxLanes, TellApartBoxesTheSmallestNumberApart) {
  BoxLanes lanes;
  lanes.clear();
  lanes.set(3, Vec3::Zero(), Vec3::Ones(), 0);
  const double above = std::nextafter(1.0, 2.0);

  EXPECT_EQ(lanes.overlaps<8>(Vec3::Ones(), Vec3(2, 2, 2)), 8u);
  EXPECT_EQ(lanes.overlaps<8>(Vec3(above, 0, 0), Vec3(2, 2, 2)), 0u);
  EXPECT_EQ(lanes.overlaps<8>(Vec3(-1, -1, -1), Vec3(1, 1, -5e-324)), 0u);
}

}  // namespace
}  // namespace plekton::geometry::box_lanes_test
