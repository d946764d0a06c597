// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/state/rotation_step.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "tests/support/beam_structure.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace plekton::test::a15_beam_rotation_test {
namespace {

// A link of length 40 mm, sheared by 0.5 mm, is carried through one revolution as the leapfrog
// turns nodes. Integrated shear would grow by exp(2 pi² / N) - 1 = 2 %; the total form has nothing
// to drift.
TEST(A15BeamRotation, APreShearedLinkKeepsItsForceThroughARevolution) {
  constexpr int kSteps = 1000;
  constexpr double kTimeStep = 1e-4;  // s
  constexpr double kSpin = 2.0 * std::numbers::pi / (kSteps * kTimeStep);
  Scene scene = chain(1, 0.04, dynamics::circular_section(0.02, 1e6, 0.3));
  scene.state.position[1].y() += 5e-4;
  const Vec3 start = scene.state.position[1];
  BeamBonds bonds(scene.bonds, 2);
  const Eigen::VectorXd at_start = bond_forces(bonds, scene.state);

  double largest_change = 0.0;
  for (int step = 1; step <= kSteps; ++step) {
    for (Quat& orientation : scene.state.orientation) {
      orientation = dynamics::turned(orientation, Vec3(0.0, 0.0, kSpin), kTimeStep);
    }
    const Quat turn = dynamics::turned(Quat::Identity(), Vec3(0.0, 0.0, kSpin), kTimeStep * step);
    scene.state.position[1] = turn * start;
    Eigen::VectorXd co_rotated = bond_forces(bonds, scene.state);
    for (Eigen::Index i = 0; i < co_rotated.size(); i += 3) {
      co_rotated.segment<3>(i) = turn.conjugate() * Vec3(co_rotated.segment<3>(i));
    }
    largest_change =
        std::max(largest_change, (co_rotated - at_start).norm() / at_start.head<3>().norm());
  }

  EXPECT_GT(at_start.head<3>().norm(), 1.0);
  EXPECT_LT(largest_change, 1e-6);
}

}  // namespace
}  // namespace plekton::test::a15_beam_rotation_test
