// SPDX-License-Identifier: GPL-3.0-or-later
// A9: in a concave valley a ball has one contact with the side it follows, and a second one where
// the other side comes in range; at the bottom both push alike, 2 F_n cos(angle) together.
#include "tests/support/sweep_paths.hpp"

#include <gtest/gtest.h>

namespace plekton::test::a09_valley_test {
namespace {

using namespace dragged;

constexpr double kAngle = radians(20.0);

/// Down one side of the valley and up the other, always at the same distance from the nearer side.
/// @param steps  even, so that one of the points is the bottom
std::vector<Vec3> path_through_valley(double reach, int steps) {
  std::vector<Vec3> path;
  for (int k = 0; k <= steps; ++k) {
    const double x = reach * (2.0 * k / steps - 1.0);
    path.push_back(Vec3(x, -0.08 + 0.12 * k / steps,
                        kDistance / std::cos(kAngle) + std::abs(x) * std::tan(kAngle)));
  }
  return path;
}

/// Both sides push with k_n times their overlap; the edge between them is out of range, as
/// D / cos(20 deg) > R + r.
Vec3 exact_force(const Vec3& centre) {
  Vec3 force = Vec3::Zero();
  for (const double side : {-1.0, 1.0}) {
    const Vec3 normal(-side * std::sin(kAngle), 0.0, std::cos(kAngle));
    const double overlap = kSphereRadius + kSurfaceRadius - centre.dot(normal);
    force += kNormalStiffness * std::max(overlap, 0.0) * normal;
  }
  return force;
}

TEST(A09Valley, PushesFromOneSideAndFromBothAtTheBottom) {
  const auto path = path_through_valley(0.80137, 7994);
  ContactProbe probe(folded_strip(-kAngle), kSphereRadius, frictionless());

  const auto felt = sweep(probe, path);

  int doubled = 0;
  double worst = 0.0;
  for (std::size_t k = 0; k < felt.size(); ++k) {
    const Vec3 exact = exact_force(path[k]);
    const bool from_both = exact.norm() > kNormalForce * (1.0 + 1e-9);
    doubled += from_both;
    EXPECT_EQ(felt[k].contacts, from_both ? 2u : 1u) << "step " << k;
    worst = std::max(worst, (felt[k].force - exact).norm() / kNormalForce);
    if (!from_both) {
      EXPECT_NEAR(felt[k].force.norm() / kNormalForce, 1.0, 1e-3) << "step " << k;
    }
  }
  EXPECT_GE(doubled, 20);
  EXPECT_LE(worst, 1e-3);
  const double bottom = felt[felt.size() / 2].force.norm();
  EXPECT_NEAR(bottom / (2.0 * kNormalForce * std::cos(kAngle)), 1.0, 1e-3);
  EXPECT_NEAR(bottom, 125.30, 1e-3 * 125.30);
}

// The second side's overlap grows by sin(40 deg) of the way along the first: the force is Lipschitz
// there, with no jump at the onset.
TEST(A09Valley, TheSecondSideComesInWithoutAJump) {
  for (const int steps : {200, 2000, 20000}) {
    const auto path = path_through_valley(0.02, steps);
    ContactProbe probe(folded_strip(-kAngle), kSphereRadius, frictionless());

    const auto felt = sweep(probe, path);

    const double way = 2.0 * 0.02 / std::cos(kAngle) / steps;
    EXPECT_LE(largest_jump(felt), 1.001 * kNormalStiffness * way * std::sin(2.0 * kAngle))
        << steps << " steps";
  }
}

}  // namespace
}  // namespace plekton::test::a09_valley_test
