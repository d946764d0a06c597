// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/beam_bond.hpp"

#include "dynamics/structure/beam_bonds.hpp"
#include "tests/support/beam_structure.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plekton::test::beam_bond_test {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kRadius = 0.2;
constexpr double kLength = 1.3;
const BeamSection kSection = dynamics::circular_section(kRadius, 7.0, 0.25);

/// Largest entry of the stiffness matrix that a force is made of, times the length: a force scale.
double force_scale() {
  return kSection.young_modulus *
         (kSection.area + 12.0 * kSection.second_moment / (kLength * kLength));
}

/// A bond at rest between two nodes that are turned at random, in a random direction.
Scene bond_at_rest(Random& random) {
  Scene scene;
  const Vec3 start = random.in_cube(2.0);
  scene.add_node(start);
  scene.add_node(start + kLength * random.direction());
  for (Quat& orientation : scene.state.orientation) orientation = Quat(random.rotation());
  scene.add_beam(NodeId{0}, NodeId{1}, kSection, 1000.0);
  return scene;
}

/// Each node moved by up to 0.4 lengths and turned by up to 1 rad per axis.
Eigen::VectorXd large_displacement(Random& random) {
  Eigen::VectorXd displacement(12);
  for (Eigen::Index i = 0; i < 12; i += 6) {
    displacement.segment<3>(i) = random.in_cube(0.4 * kLength);
    displacement.segment<3>(i + 3) = random.in_cube(1.0);
  }
  return displacement;
}

double energy_of(BeamBonds& bonds, const NodeState& state) {
  geometry::ThreadPool pool;
  bonds.advance(state, pool);
  return bonds.elastic_energy();
}

/// The 12 x 12 matrix of Euler and Bernoulli for a beam along x.
Eigen::MatrixXd euler_bernoulli_matrix() {
  const double l = kLength;
  const double axial = kSection.young_modulus * kSection.area / l;
  const double bending = kSection.young_modulus * kSection.second_moment / l;
  const double twist = kSection.shear_modulus * kSection.torsion_constant / l;
  const auto row = [](double a, double b, double c, double d) {
    return Eigen::RowVector4d(a, b, c, d);
  };
  Eigen::Matrix4d bend;  // v_a, theta_a, v_b, theta_b
  bend << row(12 / (l * l), 6 / l, -12 / (l * l), 6 / l), row(6 / l, 4, -6 / l, 2),
      row(-12 / (l * l), -6 / l, 12 / (l * l), -6 / l), row(6 / l, 2, -6 / l, 4);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(12, 12);
  const std::array<int, 4> in_xy{1, 5, 7, 11};
  const std::array<int, 4> in_xz{2, 4, 8, 10};
  const std::array<double, 4> sign{1.0, -1.0, 1.0, -1.0};  // a turn about y lowers z
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const double value = bending * bend(static_cast<int>(i), static_cast<int>(j));
      matrix(in_xy[i], in_xy[j]) += value;
      matrix(in_xz[i], in_xz[j]) += sign[i] * sign[j] * value;
    }
  }
  for (const int i : {0, 6}) {
    for (const int j : {0, 6}) {
      matrix(i, j) = i == j ? axial : -axial;
      matrix(i + 3, j + 3) = i == j ? twist : -twist;
    }
  }
  return matrix;
}

TEST(BeamBond, HasExactlyTheStiffnessOfEulerAndBernoulliForSmallRotations) {
  constexpr double kStep = 1e-5;
  Scene scene = chain(1, kLength, kSection);
  BeamBonds bonds(scene.bonds, 2);

  const Eigen::MatrixXd error =
      stiffness_matrix(bonds, scene.state, kStep) - euler_bernoulli_matrix();

  // Third derivatives of a force are of the order of the stiffness; differences also round.
  EXPECT_LT(error.cwiseAbs().maxCoeff(),
            force_scale() * (10.0 * kStep * kStep + 10.0 * kEpsilon / kStep));
}

TEST(BeamBond, ForceAndTorqueAreTheGradientOfTheEnergyAtLargeRotations) {
  constexpr double kStep = 1e-5;
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    Scene scene = bond_at_rest(random);
    const NodeState state = displaced(scene.state, large_displacement(random));
    BeamBonds bonds(scene.bonds, 2);
    Eigen::VectorXd gradient(12);
    for (Eigen::Index k = 0; k < 12; ++k) {
      const Eigen::VectorXd change = kStep * Eigen::VectorXd::Unit(12, k);
      gradient[k] = (energy_of(bonds, displaced(state, change)) -
                     energy_of(bonds, displaced(state, -change))) /
                    (2.0 * kStep);
    }

    const Eigen::VectorXd error = bond_forces(bonds, state) + gradient;

    // Shear falls with the third power of the length, so its derivatives grow as the bond shortens.
    const double shortest = (state.position[1] - state.position[0]).norm() / kLength;
    EXPECT_LT(error.norm(), force_scale() * (30.0 * kStep * kStep / std::pow(shortest, 4) +
                                             20.0 * kEpsilon / kStep));
  }
}

TEST(BeamBond, BalancesBothMomentaAtLargeRotations) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    Scene scene = bond_at_rest(random);
    const NodeState state = displaced(scene.state, large_displacement(random));
    BeamBonds bonds(scene.bonds, 2);

    const Eigen::VectorXd f = bond_forces(bonds, state);

    const Vec3 chord = state.position[1] - state.position[0];
    const Vec3 moment = f.segment<3>(3) + f.segment<3>(9) + chord.cross(Vec3(f.segment<3>(6)));
    EXPECT_EQ((f.head<3>() + f.segment<3>(6)).norm(), 0.0);
    EXPECT_LT(moment.norm(), 32.0 * kEpsilon * force_scale() * kLength);
  }
}

TEST(BeamBond, DoesNothingAfterARigidMotion) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    Scene scene = bond_at_rest(random);
    const Quat turn(random.rotation());
    const Vec3 shift = random.in_cube(2.0);
    NodeState state = scene.state;
    for (std::size_t n = 0; n < 2; ++n) {
      state.position[n] = turn * state.position[n] + shift;
      state.orientation[n] = turn * state.orientation[n];
    }
    BeamBonds bonds(scene.bonds, 2);

    // The positions are rounded at their size of up to 8 m, 6 lengths.
    EXPECT_LT(bond_forces(bonds, state).norm(), 100.0 * kEpsilon * force_scale());
    EXPECT_LT(bonds.elastic_energy(), std::pow(100.0 * kEpsilon, 2) * force_scale() * kLength);
  }
}

TEST(BeamBond, TurnsItsForceWithARigidMotion) {
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    Scene scene = bond_at_rest(random);
    NodeState state = displaced(scene.state, large_displacement(random));
    BeamBonds bonds(scene.bonds, 2);
    const Eigen::VectorXd before = bond_forces(bonds, state);
    const double energy = bonds.elastic_energy();
    const Quat turn(random.rotation());
    for (std::size_t n = 0; n < 2; ++n) {
      state.position[n] = turn * state.position[n];
      state.orientation[n] = turn * state.orientation[n];
    }

    const Eigen::VectorXd after = bond_forces(bonds, state);

    const double shortest = (state.position[1] - state.position[0]).norm() / kLength;
    const double tolerance = 200.0 * kEpsilon * force_scale() / (shortest * shortest);
    for (Eigen::Index k = 0; k < 12; k += 3) {
      EXPECT_LT((after.segment<3>(k) - turn * Vec3(before.segment<3>(k))).norm(), tolerance);
    }
    EXPECT_NEAR(bonds.elastic_energy(), energy, tolerance * kLength);
  }
}

TEST(BeamBond, ResistsPureTwistInProportionToTheAngle) {
  constexpr double kAngle = 0.5;
  Scene scene = chain(1, kLength, kSection);
  BeamBonds bonds(scene.bonds, 2);
  const Eigen::VectorXd twisted = kAngle * Eigen::VectorXd::Unit(12, 9);

  const double torque = -bond_forces(bonds, displaced(scene.state, twisted))[9];

  // From the energy: GJ/L0 (phi - 1/30 phi⁵), then phi⁷.
  const double fourth = std::pow(kAngle, 4);
  const double twist = kSection.shear_modulus * kSection.torsion_constant / kLength * kAngle;
  EXPECT_NEAR(torque / twist, 1.0 - fourth / 30.0, 0.02 * fourth * kAngle * kAngle);
}

TEST(BeamBond, ReportsTensionAsPositive) {
  Scene scene = chain(2, 2.0 * kLength, kSection);
  scene.state.position[2].x() += 0.01 * kLength;
  BeamBonds bonds(scene.bonds, 3);

  bond_forces(bonds, scene.state);

  EXPECT_EQ(bonds.axial_force(0), 0.0);
  EXPECT_NEAR(bonds.axial_force(1), 0.01 * kSection.young_modulus * kSection.area, 1e-13);
}

TEST(BeamBond, AnswersCoincidentNodesWithBalancedForces) {
  Scene scene = chain(1, kLength, kSection);
  scene.state.position[1] = scene.state.position[0];
  BeamBonds bonds(scene.bonds, 2);

  const Eigen::VectorXd f = bond_forces(bonds, scene.state);

  const double axial = kSection.young_modulus * kSection.area;
  EXPECT_NEAR(f[6], axial, 4.0 * kEpsilon * axial);
  EXPECT_LT((f.segment<3>(3) + f.segment<3>(9)).norm(), 4.0 * kEpsilon * axial);
}

TEST(BeamBond, WithoutBendingStiffnessIsABar) {
  BeamSection bar = kSection;
  bar.second_moment = 0.0;
  bar.torsion_constant = 0.0;
  Random random(5);
  Scene scene = chain(1, kLength, bar);
  BeamBonds bonds(scene.bonds, 2);

  const Eigen::VectorXd f = bond_forces(bonds, displaced(scene.state, large_displacement(random)));

  EXPECT_EQ(f.segment<3>(3).norm(), 0.0);
  EXPECT_EQ(f.segment<3>(9).norm(), 0.0);
  EXPECT_GT(f.head<3>().norm(), 0.0);
}

TEST(BeamBond, WithoutLengthIsRefused) {
  Scene scene;
  scene.add_node(Vec3::Zero());
  scene.add_node(Vec3::Zero());

  EXPECT_THROW(dynamics::make_beam(NodeId{0}, NodeId{1}, scene.state, kSection),
               std::invalid_argument);
}

TEST(BeamBond, LiesAlongItsChordHoweverNearThatIsToTheOppositeOfX) {
  for (int exponent = 0; exponent <= 320; ++exponent) {
    const Vec3 chord(-1.0, 0.6 * std::pow(10.0, -exponent), 0.8 * std::pow(10.0, -exponent));
    Scene scene;
    scene.add_node(Vec3::Zero());
    scene.add_node(chord);

    scene.add_beam(NodeId{0}, NodeId{1}, kSection, 1000.0);

    // The nodes are not turned, so the rest rotation is the frame of the beam.
    const Vec3 x_axis = scene.bonds[0].rest_a * Vec3::UnitX();
    EXPECT_LT((x_axis - chord.normalized()).norm(), 8.0 * kEpsilon) << "1e-" << exponent;
  }
}

}  // namespace
}  // namespace plekton::test::beam_bond_test
