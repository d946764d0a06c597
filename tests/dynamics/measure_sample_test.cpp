// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measure_sample.hpp"

#include "tests/support/loaded_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace plekton::test::measure_sample_test {
namespace {

using dynamics::RegionMeasure;
using dynamics::Sample;
using geometry::Box;

constexpr double kGravity = 9.81;   // m/s²
constexpr double kRadius = 0.1;     // m
constexpr double kStiffness = 1e5;  // N/m, of two spheres, and of one with a plane

double weight() {
  return 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius * 1000.0 * kGravity;
}

/// Two spheres on top of each other on a floor, where they rest.
Scene column() {
  Scene scene;
  scene.materials = {contact::Material{1e6, 0.5, 0.3}};
  scene.planes = {{Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), contact::MaterialId{0}}};
  const double low = kRadius - 2.0 * weight() / kStiffness;
  scene.add_sphere({0.0, 0.0, low}, kRadius, 1000.0, contact::MaterialId{0});
  scene.add_sphere({0.0, 0.0, low + 2.0 * kRadius - weight() / kStiffness}, kRadius, 1000.0,
                   contact::MaterialId{0});
  return scene;
}

// Two weights over the way from the floor (its contact point half the overlap behind it) to the
// lower centre, one from there to the upper one.
TEST(Sample, OfAColumnBearsWhatIsAbove) {
  LoadedSimulation simulation = simulation_of(column(), 1e-5, Vec3(0, 0, -kGravity));
  simulation.step();
  const Box box{Vec3(-1.0, -1.0, -1.0), Vec3(1.0, 1.0, 1.0)};

  const RegionMeasure measure = Sample(simulation).measure(box);

  const std::vector<Vec3> x = simulation.force_positions();
  const double foot = simulation.contact_rows().back().point[2];
  const double expected = 2.0 * weight() * (x[0][2] - foot) + weight() * (x[1][2] - x[0][2]);
  EXPECT_LT(std::abs(foot), 2.0 * weight() / kStiffness);
  EXPECT_NEAR(-measure.stress(2, 2) * 8.0, expected, 1e-9 * expected);
  EXPECT_EQ(measure.grains, 2U);
  EXPECT_EQ(measure.contacts, 1U);
  EXPECT_EQ(measure.rattlers, 1U);
  EXPECT_DOUBLE_EQ(measure.coordination, 1.5);
  EXPECT_DOUBLE_EQ(measure.fabric(2, 2), 1.0);
}

TEST(Sample, HasTheBoxOfItsGrains) {
  LoadedSimulation simulation = simulation_of(column(), 1e-5);
  simulation.step();

  const Box box = Sample(simulation).box();

  EXPECT_DOUBLE_EQ(box.lower[0], -kRadius);
  EXPECT_DOUBLE_EQ(box.upper[2], simulation.force_positions()[1][2] + kRadius);
}

TEST(Sample, DoesNotCountSpheresOfRigidBodies) {
  Scene scene = column();
  const std::vector<NodeId> nodes{scene.elements.spheres[1].nodes[0]};
  scene.add_rigid_body(nodes, {1.0, scene.state.position[1], geometry::Mat3::Identity()});
  LoadedSimulation simulation = simulation_of(std::move(scene), 1e-5);
  simulation.step();

  const RegionMeasure measure =
      Sample(simulation).measure(Box{Vec3::Constant(-1.0), Vec3::Constant(1.0)});

  EXPECT_EQ(measure.grains, 1U);
  EXPECT_EQ(measure.contacts, 0U);
  EXPECT_EQ(measure.coordination, 2.0);
}

}  // namespace
}  // namespace plekton::test::measure_sample_test
