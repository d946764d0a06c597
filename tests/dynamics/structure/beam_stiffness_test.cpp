// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/beam_stiffness.hpp"

#include "tests/support/beam_structure.hpp"
#include "tests/support/linear_algebra.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace plekton::test::beam_stiffness_test {
namespace {

using dynamics::CriticalStep;
using dynamics::Held;
using dynamics::NodalStiffness;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kMass = 2.0;     // kg
constexpr double kModulus = 1e7;  // Pa
constexpr double kRadius = 0.01;  // m
constexpr double kLength = 0.3;   // m, at rest
constexpr double kArea = std::numbers::pi * kRadius * kRadius;

/// Two free nodes of equal mass with a bond that is as long as told.
Scene two_nodes(const BeamSection& section, const Vec3& chord, double length) {
  Scene scene;
  scene.add_node(Vec3::Zero());
  scene.add_node(kLength * Vec3::UnitX());
  scene.add_beam(NodeId{0}, NodeId{1}, section, 0.0);
  scene.state.position[1] = length * chord;
  scene.properties.mass = {kMass, kMass};
  scene.properties.inertia = {1.0, 1.0};
  return scene;
}

CriticalStep step_of(const Scene& scene, double rest_length) {
  NodalStiffness stiffness(scene.state.size());
  for (const BeamBond& bond : scene.bonds) add_beam(stiffness, bond, scene.state, rest_length);
  return stiffness.critical_step(scene.properties);
}

/// omega² = k (1 / m + 1 / m) of two masses with a spring k.
double step_of_spring(double stiffness) {
  return 2.0 / std::sqrt(2.0 * stiffness / kMass);
}

TEST(BeamStiffness, OfABarBetweenEqualMassesGivesItsExactStepInAnyDirection) {
  Random random(31);
  const double expected = step_of_spring(kModulus * kArea / kLength);
  for (int trial = 0; trial < 50; ++trial) {
    const Scene scene =
        two_nodes(dynamics::bar_section(kRadius, kModulus), random.direction(), kLength);

    EXPECT_NEAR(step_of(scene, kLength).dt, expected, 16.0 * kEpsilon * expected);
  }
}

/// A string of length L under a tension T resists motions across it with T / L.
TEST(BeamStiffness, OfAStretchedBarAcrossItsChordIsThatOfAString) {
  constexpr double kNow = 0.4;  // m
  Scene scene = two_nodes(dynamics::bar_section(kRadius, kModulus), Vec3::UnitY(), kNow);
  for (Held& held : scene.properties.held) held = Held::along_y | Held::rotation;
  const double axial = kModulus * kArea / kLength;

  for (const double rest_length : {kLength, 0.38, 0.2}) {
    const double expected = step_of_spring(axial * (kNow - rest_length) / kNow);
    EXPECT_NEAR(step_of(scene, rest_length).dt, expected, 32.0 * kEpsilon * expected);
  }
  // What is pressed together does not resist.
  EXPECT_EQ(step_of(scene, 0.5).dt, std::numeric_limits<double>::infinity());
}

/// As the header says of equal beams in a chain: (E / density) / L² (7.5 + 12 A / (pi L²)), from
/// both translation and rotation.
TEST(BeamStiffness, OfAChainOfEqualBeamsLimitsTranslationAndRotationAlike) {
  constexpr double kDensity = 1200.0;  // kg/m³
  for (const double length : {0.05, 0.3, 2.0}) {
    Scene scene =
        chain(6, 6.0 * length, dynamics::circular_section(kRadius, kModulus, 0.3), kDensity);
    const double squared = kModulus / kDensity / (length * length) *
                           (7.5 + 12.0 * kArea / (std::numbers::pi * length * length));
    const double expected = 2.0 / std::sqrt(squared);
    const auto step_with = [&](Held held) {
      for (Held& of_node : scene.properties.held) of_node = held;
      NodalStiffness stiffness(scene.state.size());
      for (const BeamBond& bond : scene.bonds) add_beam(stiffness, bond, scene.state);
      return stiffness.critical_step(scene.properties).dt;
    };

    EXPECT_NEAR(step_with(Held::translation), expected, 100.0 * kEpsilon * expected);
    EXPECT_NEAR(step_with(Held::rotation), expected, 100.0 * kEpsilon * expected);
  }
}

/// sum (v . T v + r . R r) over the nodes is not below twice the energy of the 12 x 12 matrix of
/// Euler and Bernoulli, whatever the masses: with any of them the step is not above the exact one.
TEST(BeamStiffness, IsNotBelowTheMatrixOfEulerAndBernoulliForAnyMasses) {
  Random random(32);
  for (int trial = 0; trial < 100; ++trial) {
    const double radius = kLength * std::pow(10.0, random.uniform(-3.0, -0.5));
    Scene scene = two_nodes(dynamics::circular_section(radius, kModulus, random.uniform(-0.5, 0.5)),
                            Vec3::UnitX(), kLength);
    for (std::size_t i = 0; i < 2; ++i) {
      scene.properties.mass[i] = std::pow(10.0, random.uniform(-2.0, 2.0));
      scene.properties.inertia[i] =
          scene.properties.mass[i] * radius * radius * std::pow(10.0, random.uniform(-2.0, 2.0));
    }
    BeamBonds bonds(scene.bonds, 2);
    const Eigen::MatrixXd matrix = stiffness_matrix(bonds, scene.state, 1e-5 * kLength);
    Eigen::VectorXd root(12);
    for (Eigen::Index k = 0; k < 12; ++k) {
      const auto node = static_cast<std::size_t>(k / 6);
      root[k] =
          1.0 / std::sqrt(k % 6 < 3 ? scene.properties.mass[node] : scene.properties.inertia[node]);
    }
    const Eigen::MatrixXd scaled = root.asDiagonal() * matrix * root.asDiagonal();
    const double exact = 2.0 / std::sqrt(eigenvalues_of(0.5 * (scaled + scaled.transpose()))[11]);

    // Differences of forces are right to about 1e-6.
    EXPECT_LE(step_of(scene, kLength).dt, (1.0 + 1e-5) * exact);
  }
}

TEST(BeamStiffness, OfABondWithoutLengthCountsAsLongAsAtRest) {
  const BeamSection section = dynamics::circular_section(kRadius, kModulus, 0.3);
  const double at_rest = step_of(two_nodes(section, Vec3::UnitX(), kLength), kLength).dt;

  EXPECT_EQ(step_of(two_nodes(section, Vec3::UnitX(), 0.0), kLength).dt, at_rest);
}

}  // namespace
}  // namespace plekton::test::beam_stiffness_test
