// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/bond_stress.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace plekton::dynamics::bond_stress_test {
namespace {

constexpr double kRadius = 0.01;  // m

TEST(BondStress, IsThatOfTheOutermostFibreOfARoundBar) {
  BondForces forces;
  forces.tension = -30.0;
  forces.moment_a = Vec3(0.0, 0.3, 0.4);
  forces.moment_b = Vec3(0.0, 0.0, 0.1);
  forces.torque = -0.2;

  const BondStress stress = bond_stress(forces, circular_section(kRadius, 1e9, 0.3));

  const double area = std::numbers::pi * kRadius * kRadius;
  const double third = kRadius * kRadius * kRadius;
  EXPECT_NEAR(stress.axial, -30.0 / area, 1e-12 * 30.0 / area);
  // 4 M / (pi r³) and 2 T / (pi r³)
  const double bending = 4.0 * 0.5 / (std::numbers::pi * third);
  const double torsion = 2.0 * 0.2 / (std::numbers::pi * third);
  EXPECT_NEAR(stress.bending, bending, 1e-12 * bending);
  EXPECT_NEAR(stress.torsion, torsion, 1e-12 * torsion);
}

TEST(BondStress, OfABarIsAxialAlone) {
  BondForces forces;
  forces.tension = 10.0;

  const BondStress stress = bond_stress(forces, bar_section(kRadius, 1e9));

  EXPECT_GT(stress.axial, 0.0);
  EXPECT_EQ(stress.bending, 0.0);
  EXPECT_EQ(stress.torsion, 0.0);
}

}  // namespace
}  // namespace plekton::dynamics::bond_stress_test
