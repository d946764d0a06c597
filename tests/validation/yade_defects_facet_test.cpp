// SPDX-License-Identifier: GPL-3.0-or-later
// What YADE gets wrong about balls on facets, each as a test that fails where it is wrong. The
// numbers D1 to D16 are those of tests/validation/README.md, which says where the others are.
//
// The acceptance checks ask much of the same for one set of parameters: A6 (D1, D2), A7 (D2b), A8
// (D2a), A12 (D4), A19 (D7). Here are other ones, and what only the defect would change.
#include "tests/support/bodies_of_cells.hpp"
#include "tests/support/closest_weights.hpp"
#include "tests/support/glued_sphere.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/sweep_paths.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace plekton::test::yade_defects_facet_test {
namespace {

using namespace dragged;

constexpr double kReach = kSphereRadius + kSurfaceRadius;
using Corners = std::array<Vec3, 3>;

/// A needle, an obtuse and a nearly equilateral facet: no two sides of any are alike.
const std::array<Corners, 3> kFacets{{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.9, 0.2, 0)},
                                      {Vec3(0, 0, 0), Vec3(0.5, 0, 0), Vec3(-0.4, 0.35, 0)},
                                      {Vec3(0, 0, 0), Vec3(0.8, 0.05, 0), Vec3(0.35, 0.7, 0)}}};

ProbedSurface facet_of(const Corners& corners) {
  return {{corners.begin(), corners.end()}, {{0, 1, 2}}, {}, kSurfaceRadius};
}

// YADE until 2021 gave the share of node 2 to node 1, that of 3 to 2 and that of 1 to 3.
TEST(D01_FacetWeights, ArePermutedNeitherInForcesNorInVelocities) {
  for (const Corners& corners : kFacets) {
    for (const Vec3& weights : {Vec3(0.5, 0.3, 0.2), Vec3(0.2, 0.5, 0.3), Vec3(0.25, 0.15, 0.6)}) {
      ContactProbe probe(facet_of(corners), kSphereRadius, no_slip());
      const Vec3 place = at_weights(corners, weights) + kDistance * Vec3::UnitZ();
      const Felt felt = probe.put(place);
      for (std::size_t i = 0; i < 3; ++i) {
        const int k = static_cast<int>(i);
        EXPECT_NEAR(-probe.forces().force[i].z(), weights[k] * kNormalForce, 1e-9 * kNormalForce);

        ContactProbe moving(facet_of(corners), kSphereRadius, no_slip());
        moving.put(place);
        moving.velocity()[i] = Vec3(1e-3, 0, 0);  // m/s, of this node alone, for 1 s
        const double slip = moving.feel().force.x() / kTangentialStiffness;
        EXPECT_NEAR(slip, weights[k] * 1e-3, 1e-12);
      }
      EXPECT_NEAR(felt.force.z(), kNormalForce, 1e-9 * kNormalForce);
    }
  }
}

/// Forces of a ball at a place, against those from the closest point. @returns whether it touches
bool expect_force_of_closest_point(const Corners& corners, const Vec3& place) {
  const Vec3 weights = closest_weights(corners, place);
  const Vec3 away = place - at_weights(corners, weights);
  if (away.norm() >= kReach) return false;
  ContactProbe probe(facet_of(corners), kSphereRadius, frictionless());
  const Vec3 exact = kNormalStiffness * (kReach - away.norm()) * away.normalized();

  const Felt felt = probe.put(place);

  EXPECT_EQ(felt.contacts, 1u) << "at " << place.transpose();
  EXPECT_LE((felt.force - exact).norm(), 1e-9 * exact.norm()) << "at " << place.transpose();
  return true;
}

// YADE tests a ball beside side (1,2) against side (1,3), and so on: none of 9 balls beside a facet
// touches it.
TEST(D02_FacetEdges, ASphereBesideEverySideOfAFacetTouches) {
  for (const Corners& corners : kFacets) {
    for (const Vec3& place : places_beside_edges(corners, {0.02, 0.11}))
      EXPECT_TRUE(expect_force_of_closest_point(corners, place));
  }
}

// YADE: 108 of 116 balls outside a facet feel a wrong force, 103 none.
TEST(D02_FacetEdges, NoneOf116BallsOutsideAFacetIsMissed) {
  Random random(2);
  for (const Corners& corners : kFacets) {
    for (int touching = 0; touching < 116;) {
      const Vec3 place(random.uniform(-0.5, 1.1), random.uniform(-0.1, 0.8),
                       random.uniform(0.02, 0.12));
      if (closest_weights(corners, place).minCoeff() > 0.0) continue;
      touching += expect_force_of_closest_point(corners, place);
    }
  }
}

// YADE: nothing on the whole arc around the ridge, and jumps of F_n where it begins and ends.
TEST(D02a_Ridge, PushesInTheWedgeAboveItHoweverSharp) {
  for (const double angle : {5.0, 45.0, 80.0}) {
    const auto path = over_ridge(radians(angle), 0.05, 2000);
    ContactProbe probe(folded_strip(radians(angle)), kSphereRadius, frictionless());
    const auto felt = sweep(probe, centres(path));
    for (std::size_t k = 0; k < felt.size(); ++k) {
      ASSERT_EQ(felt[k].contacts, 1u) << angle << " degrees, step " << k;
      ASSERT_LE((felt[k].force - kNormalForce * path[k].normal).norm(), 1e-6 * kNormalForce);
    }
  }
}

// YADE: in 16 of 32 crossings of sides in a flat sheet the tangential force is lost, depending on
// the order in which the facets were made.
TEST(D02b_FlatEdges, HandOverTheTangentialForceInAnyOrderOfFacetsAndNodes) {
  const std::vector<Vec3> square{Vec3(-0.5, -0.4, 0), Vec3(0.5, -0.5, 0), Vec3(0.4, 0.5, 0),
                                 Vec3(-0.4, 0.4, 0)};
  const auto there = line(Vec3(0.2, -0.15, kDistance), Vec3(-0.15, 0.2, kDistance), 100);
  std::vector<Vec3> back(there.rbegin(), there.rend());
  std::array<int, 4> order{0, 1, 2, 3};
  do {
    for (const bool swapped : {false, true}) {
      ProbedSurface sheet{std::vector<Vec3>(4), {}, {}, kSurfaceRadius};
      for (std::size_t i = 0; i < 4; ++i)
        sheet.nodes[static_cast<std::size_t>(order[i])] = square[i];
      sheet.facets = {{order[0], order[1], order[2]}, {order[0], order[2], order[3]}};
      if (swapped) std::swap(sheet.facets[0], sheet.facets[1]);
      for (const auto& path : {there, back}) {
        ContactProbe probe(sheet, kSphereRadius, no_slip());
        const Felt end = sweep(probe, path).back();
        const Vec3 exact = -kTangentialStiffness * (path.back() - path.front());
        EXPECT_LE((end.force.head<2>() - exact.head<2>()).norm(), 1e-9 * exact.norm());
      }
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

// YADE keeps the third node's share as it was when the ball left the face: (1, 1e-4, 1e-4) for
// ever, where it is (1, 0, 0).
TEST(D03_LeftFace, LeavesNoShareWithNodesOfTheFace) {
  for (const Corners& corners : kFacets) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
      const Vec3 outward = (corners[i] - middle).normalized();
      const Vec3 height = (kReach - 0.001) * Vec3::UnitZ();
      ContactProbe probe(facet_of(corners), kSphereRadius, frictionless());
      for (const Vec3& centre :
           line(corners[i] - 0.02 * outward + height, corners[i] + 0.01 * outward + height, 300)) {
        const Felt felt = probe.drag(centre);
        const Vec3 weights = closest_weights(corners, centre);
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3 share = -weights[static_cast<int>(k)] * felt.force;
          ASSERT_LE((probe.forces().force[k] - share).norm(), 1e-9 * felt.force.norm());
        }
      }
      for (std::size_t k = 0; k < 3; ++k) {
        if (k != i) {
          EXPECT_TRUE(probe.forces().force[k].isZero(0.0)) << "node " << k;
        }
      }
    }
  }
}

// YADE gives the nodes of a facet no torque of the tangential force: (r - u/2) n x F_s is missing
// from the sum, 0.11 F_n R here.
TEST(D04_FrictionOnFacets, LeavesNoMomentOfSphereAndFacet) {
  const double missing_in_yade =
      (kSurfaceRadius - 0.5 * kOverlap) * std::tan(radians(20.0)) * kNormalForce;
  for (const Corners& corners : kFacets) {
    ContactProbe probe(facet_of(corners), kSphereRadius, material(20.0));
    const Vec3 from = at_weights(corners, Vec3(0.4, 0.3, 0.3)) + kDistance * Vec3::UnitZ();
    const auto felt = sweep(probe, line(from, from + Vec3(0.05, 0.02, 0), 50));
    EXPECT_NEAR(felt.back().force.head<2>().norm(), std::tan(radians(20.0)) * kNormalForce,
                1e-9 * kNormalForce);  // it slides
    for (const Felt& step : felt) {
      EXPECT_LE(step.moment_residual, 1e-12 * missing_in_yade);
      EXPECT_LE(step.force_residual, 1e-13 * kNormalForce);
    }
  }
}

// YADE gives the whole pull of a sphere that sticks to a facet to node 1.
TEST(D07_CohesionOnFacets, PullsAtAllNodesOfTheFacet) {
  Random random(7);
  for (int i = 0; i < 50; ++i) {
    Vec3 weights(random.uniform(0.05, 1.0), random.uniform(0.05, 1.0), random.uniform(0.05, 1.0));
    weights /= weights.sum();
    const Vec3 foot = weights[1] * Vec3(1, 0, 0) + weights[2] * Vec3(0.2, 0.9, 0);
    glued::GluedSphere sphere({glued::kStrength, glued::kStrength, 0.0}, foot);
    sphere.move_to(-1e-5);

    const NodeForces& forces = sphere.move_to(0.5 * glued::kTension / glued::kStiffness);

    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(forces.force[k].z(), weights[static_cast<int>(k)] * 0.5 * glued::kTension,
                  1e-9 * glued::kTension);
    }
  }
}

// YADE puts the contact point of a ball on a facet at the facet's radius from the ball's centre.
TEST(D15_ContactPoint, IsInTheMiddleOfTheOverlapForUnlikeRadii) {
  ContactProbe probe(facet_of(kFacets[2]), kSphereRadius, no_slip());
  const Vec3 from = at_weights(kFacets[2], Vec3(0.4, 0.3, 0.3)) + kDistance * Vec3::UnitZ();
  const Felt felt = sweep(probe, line(from, from + Vec3(0.01, 0, 0), 10)).back();
  const double arm = kSphereRadius - 0.5 * kOverlap;
  EXPECT_NEAR(felt.torque.y(), -arm * felt.force.x(), 1e-9 * arm * std::abs(felt.force.x()));

  ContactProbe spinning(facet_of(kFacets[2]), kSphereRadius, no_slip());
  spinning.put(from);
  spinning.spin().back() = Vec3(0, 1e-3, 0);
  EXPECT_NEAR(spinning.feel().force.x(), arm * 1e-3 * kTangentialStiffness,
              1e-9 * kTangentialStiffness * arm);
}

// YADE has no contact of a cylinder with the face of a facet.
TEST(D15_CylinderOnFacet, TouchesInsideTheFaceAlone) {
  constexpr double kRange = 0.1;  // m
  Body facet;
  facet.x = {Vec3(-2, -2, 0), Vec3(2, -2, 0), Vec3(0, 3, 0)};
  facet.facets = {{0, 1, 2}};
  for (const double tilt : {0.0, 0.3, 1.5}) {
    Body cylinder = moved(chain(1, 0.5), {0.0, tilt, 0.7}, Vec3::Zero());
    const double lowest = std::min(cylinder.x[0].z(), cylinder.x[1].z());
    for (Vec3& x : cylinder.x) x.z() += 0.95 * kRange - lowest;
    StructurePair structure_pair(facet, cylinder, kRange);
    structure_pair.place(cylinder);
    EXPECT_EQ(structure_pair.patches(), 1u) << tilt;
    EXPECT_GE(structure_pair.force_on_b().z(), 0.05 * kRange * (1.0 - 1e-9)) << tilt;  // k = 1 N/m
  }
}

}  // namespace
}  // namespace plekton::test::yade_defects_facet_test
