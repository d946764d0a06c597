// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/stretched_facet.hpp"

#include "dynamics/model/scene.hpp"
#include "dynamics/structure/sheet_facets.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plekton::test::stretched_facet_test {
namespace {

using dynamics::SheetFacet;
using dynamics::SheetFacets;
using dynamics::stretched_facet;
using geometry::Mat3;
using geometry::NodeId;
using geometry::Quat;
using geometry::Vec3;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kStiffness = 2000.0;  // N/m
constexpr double kPoisson = 0.4;

/// One facet somewhere, its nodes turned at random, at rest there.
dynamics::Scene random_facet(Random& random) {
  dynamics::Scene scene;
  for (const Vec3& corner : {Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.1, 0.0), Vec3(0.3, 0.8, 0.2)}) {
    scene.add_node(corner + random.in_cube(0.1));
    scene.state.orientation.back() = Quat(random.rotation());
  }
  scene.add_sheet_facet({NodeId{0}, NodeId{1}, NodeId{2}}, {kStiffness, kPoisson, 0.5, 1e-3}, 1.0);
  return scene;
}

Eigen::Matrix2d random_force(Random& random, double smallest, double largest) {
  Eigen::Matrix2d force;
  const double shear = 0.5 * random.uniform(smallest, largest);
  force << random.uniform(smallest, largest), shear, shear, random.uniform(smallest, largest);
  return kStiffness * force;
}

/// The axes of a facet along which forces are told, in the world.
Eigen::Matrix<double, 3, 2> axes_of(const dynamics::Scene& scene) {
  const auto& x = scene.state.position;
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = (x[1] - x[0]).normalized();
  axes.col(1) = (x[1] - x[0]).cross(x[2] - x[0]).cross(x[1] - x[0]).normalized();
  return axes;
}

TEST(StretchedFacet, CarriesTheForceThatIsAskedByItsOwnLawAndTurnsNoNode) {
  Random random(5);
  geometry::ThreadPool pool;
  for (int trial = 0; trial < 200; ++trial) {
    const dynamics::Scene scene = random_facet(random);
    const Eigen::Matrix2d force = random_force(random, -0.02, 0.2);

    const auto stretched = stretched_facet(scene.sheet_facets[0], force);

    ASSERT_TRUE(stretched);
    EXPECT_EQ(stretched->facet.corners[0], dynamics::Vec2::Zero());
    EXPECT_EQ(stretched->facet.corners[1].y(), 0.0);
    EXPECT_GT(stretched->facet.corners[1].x(), 0.0);
    EXPECT_GT(stretched->facet.corners[2].y(), 0.0);
    const std::vector<SheetFacet> facets{stretched->facet};
    SheetFacets sheets(facets, scene.state.size());
    sheets.advance(scene.state, 0.0, pool);
    const auto axes = axes_of(scene);
    const Mat3 carried = sheets.membrane_force(0, scene.state.position);
    // Strains are differences of squares of about 1, of sides of about 1.
    EXPECT_LT((carried - axes * force * axes.transpose()).norm(), 50.0 * kEpsilon * kStiffness);
    contact::NodeForces forces(scene.state.size());
    sheets.add_forces(forces, pool);
    for (const Vec3& torque : forces.torque) EXPECT_LT(torque.norm(), 50.0 * kEpsilon);
  }
}

/// Of U = l I the law is N = S, S = E t / (1 - nu) (l² - 1) / 2.
TEST(StretchedFacet, IsSmallerAllWaysUnderAForceThatIsTheSameAllWays) {
  Random random(6);
  const dynamics::Scene scene = random_facet(random);
  const SheetFacet& at_rest = scene.sheet_facets[0];
  const double force = 0.2 * kStiffness;

  const auto stretched = stretched_facet(at_rest, force * Eigen::Matrix2d::Identity());

  ASSERT_TRUE(stretched);
  const double stretch = std::sqrt(1.0 + 2.0 * 0.2 * (1.0 - kPoisson));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((stretch * stretched->facet.corners[i] - at_rest.corners[i]).norm(), 8.0 * kEpsilon);
    EXPECT_TRUE(stretched->facet.rest[i].isApprox(at_rest.rest[i], 4.0 * kEpsilon));
  }
  EXPECT_NEAR(stretched->stretches[0], stretch, 4.0 * kEpsilon);
  EXPECT_NEAR(stretched->stretches[1], stretch, 4.0 * kEpsilon);
}

/// S_2 = 0: l_2² = 1 - nu (l_1² - 1), and n_1 = l_1 / l_2 E t (l_1² - 1) / 2.
TEST(StretchedFacet, NarrowsAcrossAPullAlongOneAxis) {
  Random random(7);
  const dynamics::Scene scene = random_facet(random);
  const double along = 1.1, across = std::sqrt(1.0 - kPoisson * (along * along - 1.0));
  Eigen::Matrix2d force = Eigen::Matrix2d::Zero();
  force(0, 0) = along / across * kStiffness * 0.5 * (along * along - 1.0);

  const auto stretched = stretched_facet(scene.sheet_facets[0], force);

  ASSERT_TRUE(stretched);
  EXPECT_NEAR(stretched->stretches[0], along, 8.0 * kEpsilon);
  EXPECT_NEAR(stretched->stretches[1], across, 8.0 * kEpsilon);
}

/// Pushed all ways S = E t / (1 - nu) (l² - 1) / 2 is above -E t / (2 (1 - nu)).
TEST(StretchedFacet, IsNotThereWhereTheLawCannotPushSoMuch) {
  Random random(8);
  const dynamics::Scene scene = random_facet(random);
  const double limit = kStiffness / (2.0 * (1.0 - kPoisson));

  EXPECT_TRUE(stretched_facet(scene.sheet_facets[0], -0.9 * limit * Eigen::Matrix2d::Identity()));
  EXPECT_FALSE(stretched_facet(scene.sheet_facets[0], -1.1 * limit * Eigen::Matrix2d::Identity()));
}

TEST(StretchedFacet, HasThePrincipalValuesOfAForceInOrder) {
  Eigen::Matrix2d force;
  force << 1.0, 2.0, 2.0, 4.0;  // of rank one, trace 5

  const auto [largest, smallest] = dynamics::principal_values(force);

  EXPECT_NEAR(largest, 5.0, 8.0 * kEpsilon);
  EXPECT_NEAR(smallest, 0.0, 8.0 * kEpsilon);
}

}  // namespace
}  // namespace plekton::test::stretched_facet_test
