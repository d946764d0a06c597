// SPDX-License-Identifier: GPL-3.0-or-later
// A10: a ball dragged along a chain of cylinders, straight or over the convex side of a kink, has
// one contact: |F| = F_n without friction, F_s = k_s s without slip.
//
// Plekton's contact kinematics are exact, a = 1: without spin the ball's material moves with its
// centre, so the slip s is the way of the centre, on the kink with the arc of radius D around the
// node. A code with the anti-ratcheting factor a = (R + r) / (R + r - u) has a s instead: after
// 1.6697 m of the straight chain 16980 N, against 16697 N.
#include "tests/support/sweep_paths.hpp"

#include <gtest/gtest.h>

namespace plekton::test::a10_cylinder_chain_test {
namespace {

using namespace dragged;

constexpr double kAngle = radians(25.0);
constexpr int kSteps = 6007;
constexpr double kNormalTolerance = 1e-6;
constexpr double kTangentialTolerance = 1e-3;

ProbedSurface straight_chain() {
  return chain_of_cylinders({Vec3(-1, 0, 0), Vec3(-0.4, 0, 0), Vec3(0.3, 0, 0), Vec3(1, 0, 0)});
}
ProbedSurface kinked_chain() {
  return chain_of_cylinders(
      {Vec3(-1, 0, -std::tan(kAngle)), Vec3(0, 0, 0), Vec3(1, 0, -std::tan(kAngle))});
}

/// From x = -0.83 to 0.84 m along the straight chain.
std::vector<RidgePoint> along_straight_chain() {
  std::vector<RidgePoint> path;
  for (const Vec3& centre : line(Vec3(-0.83, 0, kDistance), Vec3(0.84, 0, kDistance), kSteps)) {
    path.push_back({centre, Vec3::UnitZ()});
  }
  return path;
}

void expect_constant_normal_force(const ProbedSurface& chain, std::span<const RidgePoint> path) {
  ContactProbe probe(chain, kSphereRadius, frictionless());

  const auto felt = sweep(probe, centres(path));

  double worst = 0.0;
  for (std::size_t k = 0; k < felt.size(); ++k) {
    EXPECT_EQ(felt[k].contacts, 1u) << "step " << k;
    worst = std::max(worst, (felt[k].force - kNormalForce * path[k].normal).norm() / kNormalForce);
  }
  EXPECT_LE(worst, kNormalTolerance);
}

/// @returns the tangential force (N) at the end
double expect_one_spring(const ProbedSurface& chain, std::span<const RidgePoint> path) {
  ContactProbe probe(chain, kSphereRadius, no_slip());

  const auto felt = sweep(probe, centres(path));

  double way = 0.0;
  double worst_normal = 0.0;
  double worst_tangential = 0.0;
  double longest_step = 0.0;
  for (std::size_t k = 1; k < felt.size(); ++k) {
    const Vec3 tangent = Vec3::UnitY().cross(path[k].normal);
    const double step = (path[k].centre - path[k - 1].centre).norm();
    longest_step = std::max(longest_step, step);
    way += step;
    const double spring = kTangentialStiffness * way;
    worst_normal =
        std::max(worst_normal, std::abs(felt[k].force.dot(path[k].normal) / kNormalForce - 1.0));
    worst_tangential =
        std::max(worst_tangential, std::abs(-felt[k].force.dot(tangent) / spring - 1.0));
    EXPECT_NEAR(felt[k].force.y(), 0.0, 1e-9 * spring);
  }
  EXPECT_LE(worst_normal, kNormalTolerance);
  EXPECT_LE(worst_tangential, kTangentialTolerance);
  return -felt.back().force.dot(Vec3::UnitY().cross(path.back().normal));
}

TEST(A10CylinderChain, PushesWithTheSameForceOverStraightJoints) {
  expect_constant_normal_force(straight_chain(), along_straight_chain());
}

TEST(A10CylinderChain, PushesWithTheSameForceAroundAKink) {
  expect_constant_normal_force(kinked_chain(), over_ridge(kAngle, 0.8, kSteps));
}

TEST(A10CylinderChain, HandsTheSpringOverStraightJoints) {
  const double end = expect_one_spring(straight_chain(), along_straight_chain());

  EXPECT_NEAR(end, kTangentialStiffness * 1.67, kTangentialTolerance * end);  // 16700 N
}

TEST(A10CylinderChain, HandsTheSpringAroundAKink) {
  const double end = expect_one_spring(kinked_chain(), over_ridge(kAngle, 0.8, kSteps));

  const double way = 2.0 * 0.8 + 2.0 * kAngle * kDistance;
  EXPECT_NEAR(end, kTangentialStiffness * way, kTangentialTolerance * end);
}

}  // namespace
}  // namespace plekton::test::a10_cylinder_chain_test
