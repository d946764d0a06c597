// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/lumped_mass.hpp"

#include "dynamics/scene.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

namespace plekton::dynamics {
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

TEST(LumpedMass, OfAFacetWithoutAreaIsZero) {
  Scene scene;
  for (const double x : {0.0, 1.0, 2.0}) scene.add_node(Vec3(x, 0.0, 0.0));

  add_facet_mass(scene.properties, {{NodeId{0}, NodeId{1}, NodeId{2}}, 0.1}, scene.state.position,
                 500.0);

  EXPECT_EQ(total(scene.properties.mass), 0.0);
}

}  // namespace
}  // namespace plekton::dynamics
