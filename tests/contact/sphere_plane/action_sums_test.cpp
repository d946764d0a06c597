// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_plane/action_sums.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace plekton::contact::action_sums_test {
namespace {

TEST(ActionSums, AreTheSameInAnyOrderAndInAnyParts) {
  test::Random random(3);
  std::vector<PlaneAction> actions;
  for (int i = 0; i < 200; ++i)
    actions.push_back({random.in_cube(1e3), random.in_cube(1.0), random.uniform(0.0, 1e-4)});
  ActionSums sums, first, second;
  for (const PlaneAction& action : actions) sums.add(action);
  std::ranges::reverse(actions);
  for (std::size_t i = 0; i < actions.size(); ++i) (i % 3 == 0 ? first : second).add(actions[i]);
  first += second;
  const PlaneAction total = sums.total(), other = first.total();
  EXPECT_EQ(total.force, other.force);
  EXPECT_EQ(total.moment, other.moment);
  EXPECT_EQ(total.push, other.push);

  PlaneAction plain;
  for (const PlaneAction& action : actions) {
    plain.force += action.force;
    plain.moment += action.moment;
    plain.push += action.push;
  }
  // Each addition of the plain sum rounds by at most half of its last place.
  const double rounding = 200 * 0x1p-53;
  EXPECT_LE((total.force - plain.force).norm(), rounding * 200 * 1e3 * 2);
  EXPECT_LE((total.moment - plain.moment).norm(), rounding * 200 * 2);
  EXPECT_LE(std::abs(total.push - plain.push), rounding * 200 * 1e-4);
}

TEST(ActionSums, OfNothingAreZero) {
  const PlaneAction total = ActionSums().total();
  EXPECT_EQ(total.force, Vec3(0, 0, 0));
  EXPECT_EQ(total.moment, Vec3(0, 0, 0));
  EXPECT_EQ(total.push, 0.0);
}

}  // namespace
}  // namespace plekton::contact::action_sums_test
