// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/sheet_bounds.hpp"

#include "tests/support/linear_algebra.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/sheet_structure.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace plekton::test::sheet_bounds_test {
namespace {

constexpr double kThickness = 0.02;  // m
constexpr double kStep = 1e-6;       // m and rad, of differences
// Differences of forces over two steps: rounding over the step, and the step squared.
constexpr double kTolerance = 1e-6;

/// One facet in the plane z = 0.
Scene facet_of(const std::array<Vec3, 3>& corners) {
  Scene scene;
  for (const Vec3& corner : corners) scene.add_node(corner);
  scene.add_sheet_facet({NodeId{0}, NodeId{1}, NodeId{2}},
                        dynamics::solid_sheet(kThickness, 1e6, 0.3), 1000.0);
  return scene;
}

Scene random_facet(Random& random) {
  std::array<Vec3, 3> corners;
  do {
    for (Vec3& corner : corners) {
      corner = random.in_cube(1.0);
      corner.z() = 0.0;
    }
  } while ((corners[1] - corners[0]).cross(corners[2] - corners[0]).norm() < 0.1);
  return facet_of(corners);
}

/// 18 x 18, by differences of the forces; symmetric but for their error.
Eigen::MatrixXd stiffness_of(const Scene& scene) {
  SheetFacets sheets(scene.sheet_facets, scene.state.size());
  Eigen::MatrixXd stiffness(18, 18);
  for (Eigen::Index k = 0; k < 18; ++k) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(18, k);
    stiffness.col(k) = (sheet_forces(sheets, moved(scene.state, -step)) -
                        sheet_forces(sheets, moved(scene.state, step))) /
                       (2.0 * kStep);
  }
  return 0.5 * (stiffness + stiffness.transpose());
}

/// Largest eigenvalue for some of the six motions of each node, those from the fourth on times a factor.
double largest_of(const Eigen::MatrixXd& stiffness, const std::vector<Eigen::Index>& motions,
                  double per_turn) {
  std::vector<Eigen::Index> all;
  for (Eigen::Index node = 0; node < 3; ++node)
    for (const Eigen::Index motion : motions) all.push_back(6 * node + motion);
  const auto count = static_cast<Eigen::Index>(all.size());
  Eigen::MatrixXd part(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      const Eigen::Index a = all[static_cast<std::size_t>(i)];
      const Eigen::Index b = all[static_cast<std::size_t>(j)];
      part(i, j) = stiffness(a, b) * (a % 6 < 3 ? 1.0 : per_turn) * (b % 6 < 3 ? 1.0 : per_turn);
    }
  }
  return eigenvalues_of(part).maxCoeff();
}

TEST(SheetBounds, AtRestAreThoseOfTheStiffnessMatrixOrAboveThem) {
  Random random(31);
  for (int trial = 0; trial < 50; ++trial) {
    const Scene scene = random_facet(random);
    const dynamics::SheetFacet& facet = scene.sheet_facets[0];
    const dynamics::SheetBounds bounds = dynamics::bounds_of(facet, dynamics::spring_of(facet));
    const Eigen::MatrixXd stiffness = stiffness_of(scene);

    const double across = largest_of(stiffness, {2, 3, 4}, 1.0 / std::sqrt(bounds.gyration));
    EXPECT_NEAR(across, bounds.across, kTolerance * bounds.across);
    const double in_plane = largest_of(stiffness, {0, 1}, 1.0);
    EXPECT_LE(in_plane, (1.0 + kTolerance) * bounds.in_plane);
    EXPECT_GE(in_plane, 0.5 * bounds.in_plane);
    const double turning = largest_of(stiffness, {5}, 1.0);
    EXPECT_LE(turning, (1.0 + kTolerance) * bounds.turning);
    EXPECT_GE(turning, (0.5 - kTolerance) * bounds.turning);
    EXPECT_NEAR(bounds.gyration, 0.4 * 0.25 * kThickness * kThickness,
                1e-15 * kThickness * kThickness);
  }
}

}  // namespace
}  // namespace plekton::test::sheet_bounds_test
