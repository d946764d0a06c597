// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/beam_bond.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "tests/support/beam_structure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

// Bonds that are bent far.
namespace plekton::test::beam_bending_test {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kLength = 1.3;
const BeamSection kSection = dynamics::circular_section(0.2, 7.0, 0.25);
const double kStiffness = kSection.young_modulus * kSection.second_moment / kLength;  // N m

/// A bond whose ends are turned apart by an angle, half at each, about an axis across it.
Eigen::VectorXd bent_by(double angle, const Vec3& axis) {
  Eigen::VectorXd displacement = Eigen::VectorXd::Zero(12);
  displacement.segment<3>(3) = -0.5 * angle * axis;
  displacement.segment<3>(9) = 0.5 * angle * axis;
  return displacement;
}

TEST(BeamBending, ResistsPureBendingByTheAngleBetweenItsEndsTimesItsStiffness) {
  // M = EI/L0 theta. The axes of the ends are rounded by some epsilon each.
  const Vec3 axis(0.0, 0.6, 0.8);
  Scene scene = chain(1, kLength, kSection);
  BeamBonds bonds(scene.bonds, 2);
  for (int degrees = 1; degrees < 180; ++degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const double moment = kStiffness * angle;

    const Eigen::VectorXd f = bond_forces(bonds, displaced(scene.state, bent_by(angle, axis)));

    const double tolerance = 16.0 * kEpsilon * kStiffness / std::cos(0.5 * angle);
    ASSERT_LT(tolerance, 1e-12 * moment);
    EXPECT_LT((f.segment<3>(3) - moment * axis).norm(), tolerance) << degrees << " degrees";
    EXPECT_LT((f.segment<3>(9) + moment * axis).norm(), tolerance) << degrees << " degrees";
    EXPECT_LT(f.segment<3>(6).norm(), tolerance / kLength) << degrees << " degrees";
    EXPECT_NEAR(bonds.elastic_energy(), 0.5 * moment * angle, tolerance) << degrees << " degrees";
  }
}

TEST(BeamBending, OfHalfATurnBalancesBothMomentaAndStaysFinite) {
  // Any side is as good as the other: the torque of bending has none.
  Scene scene = chain(1, kLength, kSection);
  BeamBonds bonds(scene.bonds, 2);
  for (const double error : {0.0, 1e-320, 1e-200, 1e-160, 1e-17, 1e-16, 1e-15, 1e-8}) {
    NodeState state = scene.state;
    state.orientation[0] = Quat(std::sqrt(0.5), 0.0, 0.0, -std::sqrt(0.5));
    state.orientation[1] = Quat(std::sqrt(0.5), error, 0.5 * error, std::sqrt(0.5) + error);

    const Eigen::VectorXd f = bond_forces(bonds, state);

    const Vec3 chord = state.position[1] - state.position[0];
    const Vec3 moment = f.segment<3>(3) + f.segment<3>(9) + chord.cross(Vec3(f.segment<3>(6)));
    EXPECT_LT(moment.norm(), 32.0 * kEpsilon * kStiffness) << error;
    // pi of bending, and what rounding makes of axes that are opposite
    EXPECT_LT(f.segment<3>(3).norm(), 4.0 * std::numbers::pi * kStiffness) << error;
    EXPECT_NEAR(bonds.elastic_energy(), 0.5 * std::pow(std::numbers::pi, 2) * kStiffness,
                10.0 * kStiffness * std::max(error, 16.0 * kEpsilon))
        << error;
  }
}

}  // namespace
}  // namespace plekton::test::beam_bending_test
