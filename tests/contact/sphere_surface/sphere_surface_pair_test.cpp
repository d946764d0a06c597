// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/sphere_surface_pair.hpp"

#include "contact/law/material_pairs.hpp"
#include "tests/support/contact_surfaces.hpp"

#include <gtest/gtest.h>

namespace plekton::test::sphere_surface_pair_test {
namespace {

constexpr double kSpring = 3e5;    // N/m
constexpr double kOverlap = 0.02;  // m

/// A ball of 0.9 m that overlaps with a flat sheet of 0.1 m.
struct BallOnSheet {
  explicit BallOnSheet(double attraction) {
    complex.x.push_back(Vec3(2.3, 2.1, 1.0 - kOverlap));
    // As of bodies of 1 m: E R is the spring.
    const auto parameters =
        MaterialPairs({{kSpring, 0.5, 0.4}})
            .combine(BodyPart{MaterialId{0}, 1.0}, BodyPart{MaterialId{0}, 1.0});
    pair = {0.9, 1.0, 1.0, attraction, id_at<NodeId>(complex.x.size() - 1), parameters};
  }
  double energy() { return normal_energy(pair, finder, all_cells(surface), complex.x); }

  Complex complex = sheet(4);
  Surface surface{complex.cylinders, complex.facets, complex.x.size() + 1};
  PatchFinder finder{surface};
  SphereSurfacePair pair;
};

TEST(SphereSurfacePair, StoresHalfTheSpringTimesTheSquareOfTheOverlap) {
  BallOnSheet ball(0.0);

  EXPECT_NEAR(ball.energy(), 0.5 * kSpring * kOverlap * kOverlap, 1e-9);
}

TEST(SphereSurfacePair, StoresLessByTheAttractionTimesTheOverlap) {
  BallOnSheet ball(50.0);

  EXPECT_NEAR(ball.energy(), 0.5 * kSpring * kOverlap * kOverlap - 50.0 * kOverlap, 1e-9);
}

TEST(SphereSurfacePair, PushesWithTheSpringTimesTheOverlapAndNoAttraction) {
  BallOnSheet ball(50.0);
  NodeForces forces(ball.complex.x.size());

  add_elastic_forces(ball.pair, ball.finder, all_cells(ball.surface), ball.complex.x, forces);

  EXPECT_NEAR((forces.force.back() - kSpring * kOverlap * Vec3::UnitZ()).norm(), 0.0, 1e-7);
  Vec3 sum = Vec3::Zero();
  for (const Vec3& force : forces.force) sum += force;
  EXPECT_NEAR(sum.norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace plekton::test::sphere_surface_pair_test
