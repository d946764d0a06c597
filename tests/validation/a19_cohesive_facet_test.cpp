// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/glued_sphere.hpp"

#include <gtest/gtest.h>

/// A19: a sphere glued to a facet, pulled off it. What YADE gives to one node (its defect D7) is
/// shared by all three.
namespace plekton::test::a19_cohesive_facet_test {
namespace {

using namespace glued;

TEST(A19, ASphereGluedToAFacetPullsItsNodesByTheirBarycentricShares) {
  const Vec3 weights(0.5, 0.3, 0.2);
  GluedSphere sphere({kStrength, kStrength, 0.0},
                     weights[1] * Vec3(1, 0, 0) + weights[2] * Vec3(0.2, 0.9, 0));
  sphere.move_to(-1e-5);
  for (const double share : {0.1, 0.5, 0.999}) {
    const double pull = share * kTension;

    const NodeForces& forces = sphere.move_to(pull / kStiffness);

    EXPECT_NEAR(forces.force[4].z(), -pull, 1e-9 * kTension);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(forces.force[i].z(), weights[static_cast<int>(i)] * pull, 1e-9 * kTension);
    EXPECT_EQ(forces.force[3].norm(), 0.0);
  }
}

TEST(A19, TheBondFailsAtExactlyItsStrength) {
  const double limit = kTension / kStiffness;
  // Above the inside of a facet, above the side that both share, and above a corner.
  for (const Vec3& foot : {Vec3(0.4, 0.2, 0), Vec3(0.6, 0.45, 0), Vec3(0, 0, 0)}) {
    GluedSphere sphere({kStrength, kStrength, 0.0}, foot);
    sphere.move_to(-1e-5);

    EXPECT_NEAR(sphere.move_to((1.0 - 1e-9) * limit).force[4].z(), -kTension, 1e-8 * kTension);
    EXPECT_EQ(sphere.touching(), 1u);
    EXPECT_EQ(sphere.move_to((1.0 + 1e-9) * limit).force[4].norm(), 0.0);
    sphere.move_to(2.0 * limit);
    EXPECT_EQ(sphere.touching(), 0u);
  }
}

TEST(A19, NothingSticksThatHasNotTouched) {
  GluedSphere sphere({kStrength, kStrength, 0.0}, Vec3(0.4, 0.2, 0));

  EXPECT_EQ(sphere.move_to(0.5 * kTension / kStiffness).force[4].norm(), 0.0);
  EXPECT_EQ(sphere.touching(), 0u);
}

}  // namespace
}  // namespace plekton::test::a19_cohesive_facet_test
