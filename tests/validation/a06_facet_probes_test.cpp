// SPDX-License-Identifier: GPL-3.0-or-later
// A6: a ball anywhere around a single facet feels k_n (R + r - d) from the closest point of the
// triangle, and the nodes share the reaction by its barycentric weights.
#include "tests/support/contact_probe.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace plekton::test {
namespace {

constexpr double kBallRadius = 0.1;    // m
constexpr double kFacetRadius = 0.05;  // m
constexpr double kReach = kBallRadius + kFacetRadius;
constexpr double kTolerance = 1e-9;
const std::array<Vec3, 3> kCorners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.35, 0.8, 0)};

using Exact = Eigen::Matrix<long double, 3, 1>;

/// Weights of the closest point, the best of the foot in the plane, those on the three lines
/// clamped to the sides: nothing in common with the kernel, and in longer numbers.
Vec3 closest_weights(const Vec3& point) {
  const auto corner = [](int i) {
    return Exact(kCorners[static_cast<std::size_t>(i)].cast<long double>());
  };
  std::vector<Exact> candidates;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Exact side = corner(j) - corner(i);
    const Exact to_point = point.cast<long double>() - corner(i);
    const long double t = std::clamp(to_point.dot(side) / side.squaredNorm(), 0.0L, 1.0L);
    Exact weights = Exact::Zero();
    weights[i] = 1.0L - t;
    weights[j] = t;
    candidates.push_back(weights);
  }
  const Exact u = corner(1) - corner(0);
  const Exact v = corner(2) - corner(0);
  const Exact p = point.cast<long double>() - corner(0);
  const long double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v);
  const long double s = (vv * p.dot(u) - uv * p.dot(v)) / (uu * vv - uv * uv);
  const long double t = (uu * p.dot(v) - uv * p.dot(u)) / (uu * vv - uv * uv);
  if (s >= 0.0L && t >= 0.0L && s + t <= 1.0L) candidates.push_back(Exact(1.0L - s - t, s, t));
  const auto distance = [&](const Exact& w) {
    return (point.cast<long double>() - w[0] * corner(0) - w[1] * corner(1) - w[2] * corner(2))
        .norm();
  };
  const Exact best =
      *std::min_element(candidates.begin(), candidates.end(),
                        [&](const Exact& a, const Exact& b) { return distance(a) < distance(b); });
  return best.cast<double>();
}

/// The facet with its corners in another order: corner i is node order[i].
ProbedSurface facet_in_order(const std::array<int, 3>& order) {
  ProbedSurface surface{std::vector<Vec3>(3), {{0, 1, 2}}, {}, kFacetRadius};
  for (std::size_t i = 0; i < 3; ++i)
    surface.nodes[static_cast<std::size_t>(order[i])] = kCorners[i];
  return surface;
}

/// Asks at the point and its mirror image, for every order of the nodes.
/// @returns whether the ball is in range
bool expect_closest_point_force(const Vec3& upper) {
  const Vec3 weights = closest_weights(upper);
  const Vec3 foot = weights[0] * kCorners[0] + weights[1] * kCorners[1] + weights[2] * kCorners[2];
  const double distance = (upper - foot).norm();
  if (distance >= kReach) return false;
  std::array<int, 3> order{0, 1, 2};
  do {
    ContactProbe probe(facet_in_order(order), kBallRadius, {1e6, 0.3, 0.5});
    for (const double side : {1.0, -1.0}) {
      const Vec3 mirror(1.0, 1.0, side);
      const Vec3 centre = mirror.cwiseProduct(upper);
      const Vec3 direction = (centre - foot) / distance;
      const Vec3 exact = probe.parameters().normal_stiffness * (kReach - distance) * direction;

      const Felt felt = probe.put(centre);

      EXPECT_EQ(felt.contacts, 1u) << "missed at " << centre.transpose();
      EXPECT_LE((felt.force - exact).norm(), kTolerance * exact.norm())
          << "at " << centre.transpose();
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& on_node = probe.forces().force[static_cast<std::size_t>(order[i])];
        const Vec3 share = -weights[static_cast<int>(i)] * exact;
        EXPECT_LE((on_node - share).norm(), kTolerance * exact.norm())
            << "node " << i << ", ball at " << centre.transpose();
      }
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return true;
}

/// From a point of the facet, by this much away from its middle and at this height.
Vec3 outside(const Vec3& on_rim, const Vec3& outward) {
  return on_rim + 0.03 * outward.normalized() + Vec3(0, 0, 0.12);
}

TEST(A06FacetProbes, FeelTheClosestPointAtThirteenPlacesFromBothSidesInEveryNodeOrder) {
  const Vec3 middle = (kCorners[0] + kCorners[1] + kCorners[2]) / 3.0;
  std::vector<Vec3> places{Vec3(0.45, 0.25, 0.13)};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 side = kCorners[(i + 1) % 3] - kCorners[i];
    const Vec3 from_middle = kCorners[i] + 0.5 * side - middle;
    const Vec3 outward = from_middle - from_middle.dot(side) / side.squaredNorm() * side;
    for (const double t : {0.3, 0.5, 0.7})
      places.push_back(outside(kCorners[i] + t * side, outward));
    places.push_back(outside(kCorners[i], kCorners[i] - middle));
  }
  ASSERT_EQ(places.size(), 13u);

  for (const Vec3& place : places)
    EXPECT_TRUE(expect_closest_point_force(place)) << place.transpose();
}

TEST(A06FacetProbes, FeelTheClosestPointAt243RandomPlacesFromBothSidesInEveryNodeOrder) {
  Random random(1);
  int in_range = 0;
  int beside = 0;
  while (in_range < 243) {
    const Vec3 place(random.uniform(-0.12, 1.12), random.uniform(-0.12, 0.92),
                     random.uniform(0.02, 0.14));
    if (!expect_closest_point_force(place)) continue;
    ++in_range;
    beside += closest_weights(place).minCoeff() == 0.0;
  }
  EXPECT_GE(beside, 80);  // of each kind a good part
  EXPECT_GE(in_range - beside, 80);
}

}  // namespace
}  // namespace plekton::test
