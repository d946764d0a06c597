// SPDX-License-Identifier: GPL-3.0-or-later
// A8: over a convex ridge the closest point is on one side, then on the edge, then on the other
// side; the normal force stays k_n times the overlap, also in the wedge over the edge.
#include "tests/support/sweep_paths.hpp"

#include <gtest/gtest.h>

namespace plekton::test::a08_ridge_test {
namespace {

using namespace dragged;

constexpr double kAngle = radians(20.0);
constexpr int kSteps = 7993;

/// Over the ridge of 20 degrees, drifting along it.
std::vector<RidgePoint> path_over_ridge() {
  auto path = over_ridge(kAngle, 0.80137 / std::cos(kAngle), kSteps);
  for (std::size_t k = 0; k < path.size(); ++k) {
    path[k].centre.y() = -0.08 + 0.12 * static_cast<double>(k) / kSteps;
  }
  return path;
}

TEST(A08Ridge, PushesWithTheSameForceOnBothSidesAndInTheWedge) {
  const auto path = path_over_ridge();
  ContactProbe probe(folded_strip(kAngle), kSphereRadius, frictionless());

  const auto felt = sweep(probe, centres(path));

  int in_wedge = 0;
  int without_force = 0;
  double worst = 0.0;
  for (std::size_t k = 0; k < felt.size(); ++k) {
    in_wedge += std::abs(path[k].normal.x()) < std::sin(kAngle) - 1e-9;
    without_force += felt[k].force.isZero(0.0);
    EXPECT_EQ(felt[k].contacts, 1u) << "step " << k;
    worst = std::max(worst, (felt[k].force - kNormalForce * path[k].normal).norm() / kNormalForce);
  }
  EXPECT_GE(in_wedge, 350);  // 2 alpha D of the way
  EXPECT_EQ(without_force, 0);
  EXPECT_LE(worst, 1e-6);  // size and direction
}

// The foot rests on the edge while the ball's own contact point goes on with the centre, so the
// slip is the way of the centre, arc included (a = 1), and the tangential force turns with the
// normal.
TEST(A08Ridge, HandsTheSpringOverTheWedgeWithoutSlip) {
  const auto path = over_ridge(kAngle, 0.8, kSteps);
  ContactProbe probe(folded_strip(kAngle), kSphereRadius, no_slip());

  const auto felt = sweep(probe, centres(path));

  const double step = (path[1].centre - path[0].centre).norm();
  double worst = 0.0;
  for (std::size_t k = 1; k < felt.size(); ++k) {
    const Vec3 tangent = Vec3::UnitY().cross(path[k].normal);
    const double spring = kTangentialStiffness * step * static_cast<double>(k);
    const Vec3 exact = kNormalForce * path[k].normal - spring * tangent;
    worst = std::max(worst, (felt[k].force - exact).norm() / spring);
  }
  EXPECT_LE(worst, 1e-3);
}

}  // namespace
}  // namespace plekton::test::a08_ridge_test
