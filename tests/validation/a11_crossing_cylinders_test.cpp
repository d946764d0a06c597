// SPDX-License-Identifier: GPL-3.0-or-later
// A11: a cylinder dragged crosswise over the joint of two others, straight or with a kink of 20
// degrees, has one contact that is handed over the joint: F_s = k_s s without slip (YADE: two
// contacts at the joint, a jump of 18.7 F_n, half of the force lost).
//
// As in A10 the kinematics are exact, a = 1: the table's 3691.4 and 3858.9 N are a s k_s with the
// factor a = 2 r / (2 r - u) = 1.02564 of a code with anti-ratcheting.
#include "tests/support/crossing_cylinders.hpp"

#include <gtest/gtest.h>

namespace plekton::test::a11_crossing_cylinders_test {
namespace {

using namespace crossing;

constexpr double kTolerance = 5e-3;

void expect_one_spring(double angle) {
  const crossing::Felt felt = drag_over_joint(angle);
  EXPECT_EQ(felt.most_patches, 1u);
  EXPECT_LE(felt.normal_error, kTolerance);
  EXPECT_LE(felt.tangential_error, kTolerance);
  const double way = 2.0 * kWay + 2.0 * angle * kDistance;
  EXPECT_NEAR(felt.end, kTangentialStiffness * way, kTolerance * felt.end);
}

TEST(A11CrossingCylinders, HandTheSpringOverAStraightJoint) {
  expect_one_spring(0.0);
}

TEST(A11CrossingCylinders, HandTheSpringOverAKink) {
  constexpr double kTwentyDegrees = 0.3490658503988659;
  expect_one_spring(kTwentyDegrees);
}

}  // namespace
}  // namespace plekton::test::a11_crossing_cylinders_test
