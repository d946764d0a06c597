// SPDX-License-Identifier: GPL-3.0-or-later
// A6: a ball anywhere around a single facet feels k_n (R + r - d) from the closest point of the
// triangle, and the nodes share the reaction by its barycentric weights.
#include "tests/support/closest_weights.hpp"
#include "tests/support/contact_probe.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace plekton::test::a06_facet_probes_test {
namespace {

constexpr double kSphereRadius = 0.1;  // m
constexpr double kFacetRadius = 0.05;  // m
constexpr double kReach = kSphereRadius + kFacetRadius;
constexpr double kTolerance = 1e-9;
const std::array<Vec3, 3> kCorners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.35, 0.8, 0)};

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
  const Vec3 weights = closest_weights(kCorners, upper);
  const Vec3 foot = weights[0] * kCorners[0] + weights[1] * kCorners[1] + weights[2] * kCorners[2];
  const double distance = (upper - foot).norm();
  if (distance >= kReach) return false;
  std::array<int, 3> order{0, 1, 2};
  do {
    ContactProbe probe(facet_in_order(order), kSphereRadius, {1e6, 0.3, 0.5});
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

TEST(A06FacetProbes, FeelTheClosestPointAtThirteenPlacesFromBothSidesInEveryNodeOrder) {
  std::vector<Vec3> places{Vec3(0.45, 0.25, 0.13)};
  for (const Vec3& beside : places_beside_edges(kCorners, {0.03, 0.12})) places.push_back(beside);
  for (const Vec3& corner : kCorners) {
    const Vec3 outward = corner - (kCorners[0] + kCorners[1] + kCorners[2]) / 3.0;
    places.push_back(corner + 0.03 * outward.normalized() + Vec3(0, 0, 0.12));
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
    beside += closest_weights(kCorners, place).minCoeff() == 0.0;
  }
  EXPECT_GE(beside, 80);  // of each kind a good part
  EXPECT_GE(in_range - beside, 80);
}

}  // namespace
}  // namespace plekton::test::a06_facet_probes_test
