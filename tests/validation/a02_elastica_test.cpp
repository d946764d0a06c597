// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/beam_structure.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace plekton::test::a02_elastica_test {
namespace {

// Tip of a cantilever under a transverse force P of constant direction, P L² / (E I) = 1, 3, 10:
// (L - x, |z|) / L of the inextensible elastica. Bisshopp & Drucker, Quart. Appl. Math. 3 (1945)
// 272.
struct Elastica {
  double load;  // P L² / (E I)
  double shortening;
  double deflection;
};
constexpr std::array<Elastica, 3> kElastica{
    {{1.0, 0.056433, 0.301721}, {3.0, 0.254420, 0.603253}, {10.0, 0.554996, 0.810609}}};

void expect_elastica(int bond_count, double tolerance) {
  for (const auto& [load, shortening, deflection] : kElastica) {
    const BeamSection section = dynamics::circular_section(0.01, 1e9, 0.25);
    Scene scene = chain(bond_count, 1.0, section);
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(first_entry(scene.state.size()));
    loads[loads.size() - 4] = -load * section.young_modulus * section.second_moment;

    balance(scene, loads, 10);

    const Vec3& tip = scene.state.position.back();
    EXPECT_NEAR((1.0 - tip.x()) / shortening, 1.0, tolerance) << "load " << load;
    EXPECT_NEAR(-tip.z() / deflection, 1.0, tolerance) << "load " << load;
  }
}

TEST(A02Elastica, IsMetBy16Bonds) {
  expect_elastica(16, 5e-3);
}

TEST(A02Elastica, IsMetMoreCloselyBy32Bonds) {
  expect_elastica(32, 1e-3);
}

// A moment of 2 pi E I / L at its tip rolls a cantilever up into a circle: the moment of a bond is
// linear in the angle between its ends, so its nodes lie on one, and the tip is where it began.
// What is left open is what the balance is solved to, 1e-11 m in each node.
void expect_closed_circle(int bond_count) {
  const BeamSection section = dynamics::circular_section(0.01, 1e9, 0.25);
  Scene scene = chain(bond_count, 1.0, section);
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(first_entry(scene.state.size()));
  loads[loads.size() - 2] = 2.0 * std::numbers::pi * section.young_modulus * section.second_moment;

  balance(scene, loads, 20);

  EXPECT_LT(rotation_vector(scene.state.orientation.back()).norm(), 1e-9) << bond_count;
  EXPECT_LT(scene.state.position.back().norm(), 1e-9) << bond_count;
  const double side = 1.0 / bond_count;
  const double radius = 0.5 * side / std::sin(std::numbers::pi * side);
  EXPECT_NEAR(scene.state.position[static_cast<std::size_t>(bond_count / 2)].norm(), 2.0 * radius,
              1e-9)
      << bond_count;
}

TEST(A02Elastica, AMomentRollsABeamUpIntoACircle) {
  for (const int bond_count : {6, 12, 20}) expect_closed_circle(bond_count);
}

}  // namespace
}  // namespace plekton::test::a02_elastica_test
