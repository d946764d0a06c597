// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/lumped_mass.hpp"

#include "dynamics/model/scene.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "tests/support/beam_structure.hpp"
#include "tests/support/linear_algebra.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace plekton::dynamics::lumped_mass_test {
namespace {

double total(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(LumpedMass, GivesHalfOfABeamToEachOfItsNodes) {
  constexpr double kRadius = 0.1;
  Scene scene;
  for (const double x : {0.0, 2.0, 3.0}) scene.add_node(Vec3(x, 0.0, 0.0));
  const BeamSection section = circular_section(kRadius, 1e6, 0.3);

  scene.add_beam(NodeId{0}, NodeId{1}, section, 1000.0);
  scene.add_beam(NodeId{1}, NodeId{2}, section, 1000.0);

  const double per_length = 1000.0 * std::numbers::pi * kRadius * kRadius;
  const std::vector<double> expected{1.0 * per_length, 1.5 * per_length, 0.5 * per_length};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(scene.properties.mass[i], expected[i]);
    EXPECT_DOUBLE_EQ(scene.properties.inertia[i], 0.4 * expected[i] * kRadius * kRadius);
  }
}

TEST(LumpedMass, GivesAThirdOfAFacetToEachOfItsNodes) {
  constexpr double kRadius = 0.1;
  Scene scene;
  const NodeId a = scene.add_node(Vec3(0.0, 0.0, 0.0));
  const NodeId b = scene.add_node(Vec3(3.0, 0.0, 0.0));
  const NodeId c = scene.add_node(Vec3(0.0, 4.0, 0.0));

  add_facet_mass(scene.properties, {{a, b, c}, kRadius}, scene.state.position, 500.0);

  EXPECT_DOUBLE_EQ(total(scene.properties.mass), 500.0 * 2.0 * kRadius * 6.0);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(scene.properties.mass[i], 200.0);
    EXPECT_DOUBLE_EQ(scene.properties.inertia[i], 0.4 * 200.0 * kRadius * kRadius);
  }
}

TEST(LumpedMass, GivesTheInertiaOfHalfABarAboutItsEndWhereThatIsAskedFor) {
  constexpr double kRadius = 0.1;
  Scene scene;
  for (const double x : {0.0, 2.0}) scene.add_node(Vec3(x, 0.0, 0.0));

  scene.add_beam(NodeId{0}, NodeId{1}, circular_section(kRadius, 1e6, 0.3), 1000.0,
                 NodalInertia::length);

  // Half a bar is 1 m long: m (r² / 4 + 1² / 3) about its end.
  const double half = 1000.0 * std::numbers::pi * kRadius * kRadius;
  EXPECT_NEAR(scene.properties.inertia[0], half * (kRadius * kRadius / 4.0 + 1.0 / 3.0),
              1e-14 * half);
}

/// Lowest frequency squared of a bar that is hinged at its ends and bends in a plane.
double bending_frequency_squared(int bars, NodalInertia inertia) {
  Scene scene;
  const BeamSection section = circular_section(0.001, 1e9, 0.3);
  for (int i = 0; i <= bars; ++i) {
    const NodeId node = scene.add_node(Vec3(static_cast<double>(i) / bars, 0.0, 0.0));
    if (i > 0)
      scene.add_beam(geometry::id_at<NodeId>(index_of(node) - 1), node, section, 1000.0, inertia);
  }
  BeamBonds bonds(scene.bonds, scene.state.size());
  const Eigen::MatrixXd whole = test::stiffness_matrix(bonds, scene.state, 1e-7);
  std::vector<Eigen::Index> free;  // along y and about z
  for (int i = 0; i <= bars; ++i) {
    if (i > 0 && i < bars) free.push_back(6 * i + 1);
    free.push_back(6 * i + 5);
  }
  const auto size = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd scaled(size, size);
  const auto root = [&](Eigen::Index entry) {
    const auto node = static_cast<std::size_t>(entry / 6);
    return std::sqrt(entry % 6 < 3 ? scene.properties.mass[node] : scene.properties.inertia[node]);
  };
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index k = 0; k < size; ++k) {
      const Eigen::Index row = free[static_cast<std::size_t>(i)];
      const Eigen::Index column = free[static_cast<std::size_t>(k)];
      scaled(i, k) = 0.5 * (whole(row, column) + whole(column, row)) / (root(row) * root(column));
    }
  }
  return test::eigenvalues_of(scaled)[0];
}

// One half wave of n bars: omega² falls by (pi / n)² / 12, to the first order of that.
TEST(LumpedMass, OfLengthsLowersBendingFrequenciesByWhatTheTurningNodesAdd) {
  for (const int bars : {5, 10, 20}) {
    const double expected = std::numbers::pi * std::numbers::pi / (12.0 * bars * bars);

    const double ratio = bending_frequency_squared(bars, NodalInertia::length) /
                         bending_frequency_squared(bars, NodalInertia::ball);

    EXPECT_NEAR(1.0 - ratio, expected, 0.05 * expected + expected * expected) << bars;
  }
}

TEST(LumpedMass, OfAFacetWithoutAreaIsZero) {
  Scene scene;
  for (const double x : {0.0, 1.0, 2.0}) scene.add_node(Vec3(x, 0.0, 0.0));

  add_facet_mass(scene.properties, {{NodeId{0}, NodeId{1}, NodeId{2}}, 0.1}, scene.state.position,
                 500.0);

  EXPECT_EQ(total(scene.properties.mass), 0.0);
}

}  // namespace
}  // namespace plekton::dynamics::lumped_mass_test
