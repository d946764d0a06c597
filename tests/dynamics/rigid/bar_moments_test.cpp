// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/rigid/bar_moments.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace plekton::dynamics::bar_moments_test {
namespace {

using geometry::NodeId;
using Edges = std::vector<std::array<NodeId, 2>>;

constexpr double kDensity = 7800.0;  // kg/m3
constexpr double kRadius = 0.03;     // m

MassProperties body_of(const std::vector<Vec3>& points, const Edges& edges) {
  const Vec3 origin = points.front() + Vec3(0.1, -0.2, 0.3);
  return mass_of(bar_moments(points, edges, kRadius, origin), kDensity, origin);
}

// A solid cylinder: m r² / 2 about its axis, m (3 r² + l²) / 12 across it.
TEST(BarMoments, OfABarAreThoseOfACylinder) {
  const Vec3 along = Vec3(2.0, -1.0, 2.0) / 3.0;
  const double length = 0.7;
  const std::vector<Vec3> points{Vec3(5, 6, 7), Vec3(5, 6, 7) + length * along};

  const MassProperties body = body_of(points, {{NodeId{1}, NodeId{0}}});

  const double mass = kDensity * std::numbers::pi * kRadius * kRadius * length;
  const double axial = 0.5 * mass * kRadius * kRadius;
  const double across = mass * (3.0 * kRadius * kRadius + length * length) / 12.0;
  EXPECT_NEAR(body.mass, mass, 1e-14 * mass);
  EXPECT_LT((body.centre - 0.5 * (points[0] + points[1])).norm(), 1e-14);
  const Mat3 expected = across * Mat3::Identity() + (axial - across) * (along * along.transpose());
  EXPECT_LT((body.inertia - expected).norm(), 1e-13 * across);
}

TEST(BarMoments, DoNotDependOnHowABarIsCut) {
  std::vector<Vec3> points;
  Edges edges;
  for (int i = 0; i <= 5; ++i) {
    points.push_back(Vec3(0.1 * i * i, 0.2 * i * i, 0.05 * i * i));
    if (i > 0) edges.push_back({NodeId{i - 1}, NodeId{i}});
  }
  const MassProperties pieces = body_of(points, edges);
  const MassProperties whole = body_of({points.front(), points.back()}, {{NodeId{0}, NodeId{1}}});

  EXPECT_NEAR(pieces.mass, whole.mass, 1e-14 * whole.mass);
  EXPECT_LT((pieces.centre - whole.centre).norm(), 1e-13);
  EXPECT_LT((pieces.inertia - whole.inertia).norm(), 1e-13 * whole.inertia.norm());
}

TEST(BarMoments, OfABarWithoutLengthAreNone) {
  EXPECT_EQ(body_of({Vec3(1, 2, 3), Vec3(1, 2, 3)}, {{NodeId{0}, NodeId{1}}}).mass, 0.0);
}

}  // namespace
}  // namespace plekton::dynamics::bar_moments_test
