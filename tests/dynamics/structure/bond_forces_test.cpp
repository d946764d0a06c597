// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/bond_forces.hpp"

#include "dynamics/structure/beam_bonds.hpp"
#include "tests/support/beam_structure.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace plekton::test::bond_forces_test {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kLength = 1.3;
const BeamSection kSection = dynamics::circular_section(0.2, 7.0, 0.25);
/// Largest entry of the stiffness matrix that a force is made of, times the length (N), and a
/// moment (N m).
const double kForceScale = kSection.young_modulus * kSection.area;

/// A bond along x from the origin, then displaced.
struct BentBond {
  explicit BentBond(const Eigen::VectorXd& displacement)
      : scene(chain(1, kLength, kSection)), bonds(scene.bonds, 2) {
    state = displaced(scene.state, displacement);
  }
  Scene scene;
  BeamBonds bonds;
  NodeState state;
};

TEST(BondForces, AddUpToWhatTheNodesFeel) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    Eigen::VectorXd displacement(12);
    for (Eigen::Index k = 0; k < 12; k += 3) displacement.segment<3>(k) = random.in_cube(0.5);
    BentBond bond(displacement);

    const dynamics::BondForces forces = bond.bonds.forces_of(0, bond.state);
    const Eigen::VectorXd felt = bond_forces(bond.bonds, bond.state);

    const Vec3 n = (bond.state.position[1] - bond.state.position[0]).normalized();
    const Vec3 axis_a = bond.state.orientation[0] * Vec3::UnitX();
    const Vec3 axis_b = bond.state.orientation[1] * Vec3::UnitX();
    Eigen::VectorXd sum(12);
    sum << forces.tension * n - forces.shear, forces.moment_a + forces.torque * axis_a,
        forces.shear - forces.tension * n, forces.moment_b - forces.torque * axis_b;
    // Each entry is a sum of some dozen terms of this size.
    EXPECT_LT((sum - felt).lpNorm<Eigen::Infinity>(), 100.0 * kEpsilon * kForceScale);
    EXPECT_LT(std::abs(forces.moment_a.dot(axis_a)), 100.0 * kEpsilon * kForceScale);
    EXPECT_LT(std::abs(forces.moment_b.dot(axis_b)), 100.0 * kEpsilon * kForceScale);
    EXPECT_EQ(forces.tension, bond.bonds.axial_force(0));
  }
}

TEST(BondForces, AreThoseOfStretchTwistAndBending) {
  constexpr double kSmall = 1e-4;  // the formulas are linear, the bond to the second order
  Eigen::VectorXd displacement = Eigen::VectorXd::Zero(12);
  displacement[6] = kSmall * kLength;
  displacement[9] = kSmall;
  displacement[5] = -0.5 * kSmall;
  displacement[11] = 0.5 * kSmall;
  BentBond bond(displacement);

  const dynamics::BondForces forces = bond.bonds.forces_of(0, bond.state);

  const double bending = kSection.young_modulus * kSection.second_moment / kLength * kSmall;
  const double twist = kSection.shear_modulus * kSection.torsion_constant / kLength * kSmall;
  EXPECT_NEAR(forces.tension, kForceScale * kSmall, 1e-10 * kForceScale);
  EXPECT_NEAR(forces.torque, twist, kSmall * twist);
  EXPECT_NEAR(forces.moment_a.z(), bending, kSmall * bending);
  EXPECT_NEAR(forces.moment_b.z(), -bending, kSmall * bending);
  // The axes of the ends, along which the torque acts, differ by the bending angle.
  EXPECT_LT(forces.shear.norm(), kSmall * (bending + twist) / kLength);
}

TEST(BondForces, VanishWithTheBond) {
  BentBond bond(Eigen::VectorXd::LinSpaced(12, -0.3, 0.4));
  EXPECT_GT(bond_forces(bond.bonds, bond.state).norm(), 0.0);

  const double stored = bond.bonds.elastic_energy();

  EXPECT_EQ(bond.bonds.break_bond(0), stored);

  EXPECT_TRUE(bond.bonds.is_broken(0));
  EXPECT_EQ(bond_forces(bond.bonds, bond.state).norm(), 0.0);
  EXPECT_EQ(bond.bonds.elastic_energy(), 0.0);
  EXPECT_EQ(bond.bonds.break_bond(0), 0.0);
  EXPECT_EQ(bond.bonds.forces_of(0, bond.state).moment_a.norm(), 0.0);
}

}  // namespace
}  // namespace plekton::test::bond_forces_test
