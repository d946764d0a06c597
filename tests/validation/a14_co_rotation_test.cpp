// SPDX-License-Identifier: GPL-3.0-or-later
// A14: a cylinder and a ball that touch and turn together as one rigid body do not slip, however
// long the cylinder is. (A spin of the cylinder taken as d x (v2 - v1), without 1 / L², would give
// |L² - 1| r omega.)
#include "tests/support/sweep_paths.hpp"

#include <gtest/gtest.h>

namespace plekton::test::a14_co_rotation_test {
namespace {

using namespace dragged;

constexpr double kTolerance = 1e-10;  // m/s

TEST(A14CoRotation, ASphereOnACylinderOfAnyLengthDoesNotSlip) {
  for (const double length : {0.1, 0.5, 1.0, 3.0}) {
    for (const double place : {0.0, 0.3}) {
      const auto cylinder =
          chain_of_cylinders({Vec3(-0.5 * length, 0, 0), Vec3(0.5 * length, 0, 0)});
      for (const Vec3& spin : {Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0.6, -0.7, 0.5)}) {
        ContactProbe probe(cylinder, kSphereRadius, no_slip());
        probe.put(Vec3(place * length, 0, kDistance));
        turn_rigidly(probe, spin);

        EXPECT_LE(slip_velocity(probe, Vec3::UnitZ()), kTolerance)
            << "length " << length << ", spin " << spin.transpose();
      }
    }
  }
}

TEST(A14CoRotation, ASphereOnAFacetDoesNotSlip) {
  ContactProbe probe(folded_strip(0.0), kSphereRadius, no_slip());
  probe.put(Vec3(0.21, 0.13, kDistance));
  turn_rigidly(probe, Vec3(0.6, -0.7, 0.5));

  EXPECT_LE(slip_velocity(probe, Vec3::UnitZ()), kTolerance);
}

// So that the checks above cannot pass by a probe that feels nothing.
TEST(A14CoRotation, ASphereThatTurnsAloneSlips) {
  ContactProbe probe(chain_of_cylinders({Vec3(-0.5, 0, 0), Vec3(0.5, 0, 0)}), kSphereRadius,
                     no_slip());
  probe.put(Vec3(0, 0, kDistance));
  probe.spin().back() = Vec3(0, 0.01, 0);

  EXPECT_NEAR(slip_velocity(probe, Vec3::UnitZ()), 0.01 * (kSphereRadius - 0.5 * kOverlap),
              kTolerance);
}

}  // namespace
}  // namespace plekton::test::a14_co_rotation_test
