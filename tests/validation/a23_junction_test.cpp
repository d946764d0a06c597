// SPDX-License-Identifier: GPL-3.0-or-later
// A23: a ball that crosses a junction of cylinders. Along a branch it has one contact, through the
// node too. Away from the branches the force changes in proportion to the step, without jumps.
//
// Between branches the ball sinks in until it rests on two or three of them, and the contact rule
// goes from one contact to as many as the pass between them leaves the range: with an overlap u at
// a distance D, each of two branches at a right angle being y away, |F| / F_n = 1 + y² / (2 D u).
// So |F| is within 2 % of F_n only up to y = sqrt(0.04 D u), 3.1 mm here.
#include "tests/support/junctions.hpp"

#include <gtest/gtest.h>

namespace plekton::test::a23_junction_test {
namespace {

using namespace dragged;

TEST(A23Junction, IsOneContactAlongABranchAndThroughTheNode) {
  const ProbedSurface star = junction(4, 0.0);
  ContactProbe probe(star, kSphereRadius, frictionless());

  const auto felt = sweep(probe, path_over(star, Vec3(-0.6, 0, 0), Vec3(0.61, 0, 0), 6007));

  for (const Felt& step : felt) {
    EXPECT_EQ(step.contacts, 1u);
    EXPECT_NEAR(step.force.norm() / kNormalForce, 1.0, 1e-9);
  }
}

TEST(A23Junction, IsOneContactOverTheNodeOfAnyNumberOfBranches) {
  for (int branches = 1; branches <= 8; ++branches) {
    ContactProbe probe(junction(branches, 0.1), kSphereRadius, frictionless());

    const Felt felt = probe.put(Vec3(0, 0, kDistance));

    EXPECT_EQ(felt.contacts, 1u) << branches << " branches";
    EXPECT_NEAR(felt.force.norm() / kNormalForce, 1.0, 1e-9) << branches << " branches";
  }
}

// Six branches are only 60 degrees apart: at the place beside the node where the node leaves the
// range, s = sqrt((R + r)² - D²) = 22 mm, the ball on one branch rests on both neighbours as well,
// at a distance of sqrt(D² + 3/4 s²). All three push: |F| = 1.49 F_n.
TEST(A23Junction, RestsOnThreeOfSixBranchesBesideTheNode) {
  constexpr double kReach = kSphereRadius + kSurfaceRadius;
  const double beside = std::sqrt(kReach * kReach - kDistance * kDistance);
  const double distance = std::sqrt(kDistance * kDistance + 0.75 * beside * beside);
  const double push = 2.0 * kNormalStiffness * (kReach - distance) / distance;
  const Vec3 exact(0.75 * beside * push, 0.0, kNormalForce + kDistance * push);
  ContactProbe probe(junction(6, 0.0), kSphereRadius, frictionless());

  const Felt felt = probe.put(Vec3(beside, 0, kDistance));

  EXPECT_NEAR((felt.force - exact).norm(), 0.0, 1e-9 * exact.norm());
  EXPECT_NEAR(felt.force.norm() / kNormalForce, 1.49, 0.005);
}

TEST(A23Junction, GoesFromOneContactToTwoBetweenBranchesAsThePassLeavesTheRange) {
  const ProbedSurface star = junction(4, 0.0);
  for (const double y : {0.001, 0.002, 0.003, 0.004}) {
    ContactProbe probe(star, kSphereRadius, frictionless());
    const Vec3 between(y, y, 0);
    const Felt felt = probe.put(between + height_over(star, between) * Vec3::UnitZ());

    const double expected = 1.0 + y * y / (2.0 * kDistance * kOverlap);
    // The next terms of the distances are y² / D² of this.
    EXPECT_NEAR(felt.force.norm() / kNormalForce, expected, 2.0 * y * y / (kDistance * kDistance));
    if (y <= 0.003) {
      EXPECT_NEAR(felt.force.norm() / kNormalForce, 1.0, 0.02);
    }
  }
}

TEST(A23Junction, ChangesInProportionToTheStepOffTheAxisOfFourBranches) {
  expect_change_in_proportion(junction(4, 0.0), Vec3(-0.1, 0.004, 0), Vec3(0.1, 0.004, 0));
}

TEST(A23Junction, ChangesInProportionToTheStepOverSixBranches) {
  expect_change_in_proportion(junction(6, 0.1), Vec3(-0.2, -0.02, 0), Vec3(0.2, 0.02, 0));
}

}  // namespace
}  // namespace plekton::test::a23_junction_test
