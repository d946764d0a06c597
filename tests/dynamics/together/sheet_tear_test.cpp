// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets that tear, and elements that are broken by name.
#include "dynamics/simulation.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/sheet_facets.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/membrane.hpp"
#include "tests/support/free_collision.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace plekton::dynamics::sheet_tear_test {
namespace {

using geometry::NodeId;
using testing::HasSubstr;

constexpr contact::MaterialId kMaterial{0};
constexpr double kModulus = 1e7;     // Pa
constexpr double kThickness = 1e-3;  // m
constexpr double kStrength = 1e5;    // Pa

/// A sheet, centred on the origin; facets near x = 0 have a strength.
Scene sheet(const geometry::PlaneSheet& shape, double strength = SheetSection::kNever) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.3}};
  const auto membrane =
      geometry::make_membrane(geometry::plane_sheet(shape), {.thickness = kThickness});
  for (const Vec3& x : membrane.nodes) scene.add_node(x);
  for (const geometry::Facet& facet : membrane.facets) {
    scene.add_facet(facet.nodes[0], facet.nodes[1], facet.nodes[2], facet.radius, kMaterial);
    SheetSection section = solid_sheet(kThickness, kModulus, 0.0);
    Vec3 middle = Vec3::Zero();
    for (const NodeId node : facet.nodes) middle += membrane.nodes[index_of(node)] / 3.0;
    if (std::abs(middle.x()) < 0.1) section.strength = strength;
    scene.add_sheet_facet(facet.nodes, section, 1000.0);
  }
  return scene;
}

/// A strip of 1 m x 0.2 m, five cells long, weak in the middle, that is pulled along x.
Scene pulled_strip() {
  Scene scene = sheet({1.0, 0.2, 5, 1}, kStrength);
  PrescribedMotion pull;
  for (std::size_t i = 0; i < scene.state.size(); ++i) {
    const double x = scene.state.position[i].x();
    if (x < -0.49) scene.properties.held[i] = Held::everything;
    if (x > 0.49) pull.nodes.push_back(geometry::id_at<NodeId>(i));
  }
  pull.held = Held::translation;
  pull.displacement = Vec3(0.02, 0.0, 0.0);
  pull.factor = TimeTable({{0.0, 0.0}, {1.0, 1.0}});
  scene.loads.motions.push_back(std::move(pull));
  return scene;
}

double pull_of(const Simulation& simulation) {
  std::vector<NodeId> held;
  for (std::size_t i = 0; i < simulation.state().size(); ++i) {
    if (simulation.properties().held[i] == Held::everything &&
        simulation.state().position[i].x() < 0.0)
      held.push_back(geometry::id_at<NodeId>(i));
  }
  return -simulation.support_reaction(held, Vec3::Zero()).force.x();
}

TEST(SheetTear, IsWhereTheSheetIsWeakAtItsStrength) {
  Simulation simulation(pulled_strip(), {.time_step = 2e-4, .motion = {.damping = 0.2}});
  double largest = 0.0;

  while (simulation.step_until(1.0)) largest = std::max(largest, std::abs(pull_of(simulation)));

  // Uniaxial without Poisson's ratio: the width stays, so the pull is strength t w. It grows by
  // 2e-5 of its value a step, and rides on waves of v / c = 0.02 m/s / 100 m/s of the modulus.
  EXPECT_NEAR(largest, kStrength * kThickness * 0.2, 0.02 * kStrength * kThickness * 0.2);
  EXPECT_EQ(simulation.elements().facets.size(), 8u);
  for (std::size_t i = 0; i < simulation.sheet_facets().size(); ++i) {
    const bool is_weak = simulation.scene().sheet_facets[i].section.strength == kStrength;
    EXPECT_EQ(simulation.sheet_facets().is_broken(i), is_weak);
  }
  EXPECT_LT(std::abs(pull_of(simulation)), 0.02 * largest);
  EXPECT_GT(simulation.energy().bond_dissipated, 0.0);
  EXPECT_LT(simulation.energy().closure(), 5e-3);
}

TEST(SheetTear, IsTheSameForAnyNumberOfThreads) {
  Simulation one(pulled_strip(), {.time_step = 2e-4, .motion = {.damping = 0.2}});
  Simulation two(pulled_strip(), {.time_step = 2e-4, .motion = {.damping = 0.2}, .threads = 2});

  while (one.step_until(0.7)) two.step_until(0.7);

  EXPECT_EQ(one.elements().facets.size(), 8u);
  EXPECT_EQ(one.state().position, two.state().position);
}

TEST(SheetTear, OfASheetWithoutStrengthNeverComes) {
  Scene scene = pulled_strip();
  for (SheetFacet& facet : scene.sheet_facets) facet.section.strength = SheetSection::kNever;
  Simulation simulation(scene, {.time_step = 2e-4, .motion = {}});

  while (simulation.step_until(1.0)) {
  }

  EXPECT_EQ(simulation.elements().facets.size(), 10u);
  EXPECT_GT(std::abs(pull_of(simulation)), kStrength * kThickness * 0.2);
}

/// A free sheet, stretched and spinning, with a ball pressed into it away from the middle.
Scene flying() {
  Scene scene = sheet({0.8, 0.8, 4, 4});
  for (std::size_t i = 0; i < scene.state.size(); ++i) {
    Vec3& x = scene.state.position[i];
    x *= 1.005;
    scene.state.velocity[i] = Vec3(0.2, 0.1, 0.3) + Vec3(0.0, 0.3, 2.0).cross(x);
    scene.state.angular_velocity[i] = Vec3(0.0, 0.3, 2.0);
  }
  scene.add_sphere(Vec3(0.25, 0.27, 0.0502), 0.05, 200.0, kMaterial);
  return scene;
}

std::array<NodeId, 3> facet_at(const Simulation& simulation, const Vec3& place) {
  const auto& facets = simulation.elements().facets;
  const auto nearest =
      std::min_element(facets.begin(), facets.end(), [&](const auto& a, const auto& b) {
        const auto way = [&](const geometry::Facet& facet) {
          Vec3 middle = Vec3::Zero();
          for (const NodeId node : facet.nodes)
            middle += simulation.state().position[index_of(node)] / 3.0;
          return (middle - place).norm();
        };
        return way(a) < way(b);
      });
  return nearest->nodes;
}

TEST(BreakFacet, KeepsMomentaAndTheEnergyBalance) {
  Simulation simulation(flying(), {.time_step = 2e-5, .motion = {}});
  const auto before = test::momenta_of(simulation);
  double drift = 0.0;

  for (int i = 0; i < 500; ++i) {
    if (i == 100) simulation.break_facet(facet_at(simulation, Vec3(-0.3, -0.3, 0.0)));
    if (i == 200) simulation.break_facet(facet_at(simulation, Vec3(0.25, 0.27, 0.0)));
    simulation.step();
    const auto now = test::momenta_of(simulation);
    drift = std::max(drift, (now.linear - before.linear).norm() / before.linear.norm());
    drift = std::max(drift, (now.angular - before.angular).norm() / before.angular.norm());
  }

  EXPECT_EQ(simulation.elements().facets.size(), 30u);
  EXPECT_LT(drift, 1e-10);
  EXPECT_LT(simulation.energy().closure(), 1e-3);
}

TEST(BreakFacet, LeavesContactsOutOfItsRangeAsTheyAre) {
  Simulation whole(flying(), {.time_step = 2e-5, .motion = {}});
  Simulation torn(flying(), {.time_step = 2e-5, .motion = {}});
  for (int i = 0; i < 50; ++i) {
    whole.step();
    torn.step();
  }
  const auto number = torn.list_contacts().at(0).id;
  torn.break_facet(facet_at(torn, Vec3(-0.3, -0.3, 0.0)));

  whole.step();
  torn.step();

  const auto row = torn.list_contacts().at(0);
  EXPECT_EQ(torn.elements().facets.size(), 31u);
  EXPECT_EQ(row.id, number);
  EXPECT_EQ(row.force(), whole.list_contacts().at(0).force());
}

TEST(BreakFacet, LeavesNothingToTouch) {
  Simulation simulation(flying(), {.time_step = 2e-5, .motion = {}});
  simulation.step();
  ASSERT_EQ(simulation.list_contacts().size(), 1u);

  simulation.break_facet(facet_at(simulation, Vec3(0.25, 0.27, 0.0)));
  simulation.step();

  EXPECT_TRUE(simulation.list_contacts().empty());
}

TEST(BreakCylinder, TakesItsBondsAlong) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.3}};
  for (int i = 0; i < 4; ++i) scene.add_node(Vec3(0.1 * i, 0.0, 0.0));
  for (int i = 0; i < 3; ++i) {
    scene.add_cylinder(NodeId{i}, NodeId{i + 1}, 0.01, kMaterial);
    scene.add_beam(NodeId{i}, NodeId{i + 1}, circular_section(0.01, 1e7, 0.3), 1000.0);
  }
  Simulation simulation(scene, {});

  simulation.break_cylinder(NodeId{2}, NodeId{1});
  simulation.step();

  EXPECT_EQ(simulation.elements().cylinders.size(), 2u);
  EXPECT_TRUE(simulation.bonds().is_broken(1));
  EXPECT_FALSE(simulation.bonds().is_broken(0));
}

TEST(BreakCylinder, RefusesWhatIsNotThere) {
  Simulation simulation(flying(), {.time_step = 2e-5, .motion = {}});
  const auto facet = facet_at(simulation, Vec3::Zero());
  simulation.break_facet(facet);
  simulation.step();

  try {
    simulation.break_facet(facet);
    FAIL() << "it was broken twice";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("there is no facet on nodes"));
  }
  EXPECT_THROW(simulation.break_cylinder(NodeId{0}, NodeId{1}), std::invalid_argument);
}

}  // namespace
}  // namespace plekton::dynamics::sheet_tear_test
