// SPDX-License-Identifier: GPL-3.0-or-later
// What breaks conserve.
#include "tests/support/breaking_net.hpp"
#include "tests/support/free_collision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace plekton::dynamics::break_energy_test {
namespace {

using test::BreakingSimulation;
using test::kMesh;
using test::kWire;
using test::momenta_of;
using test::net_node;

/// A free net or lattice membrane, stretched by 1 %, with spheres pressed into it, all in motion.
Scene flying(bool has_facets, double friction) {
  Scene scene;
  scene.materials = {{2e6, 0.5, friction}};
  test::add_net(scene, {.squares = 3,
                        .has_facets = has_facets,
                        .has_cylinders = !has_facets,
                        .rim = Held::nothing,
                        .roughness = 0.005});
  for (Vec3& x : scene.state.position) x *= 1.01;
  test::Random random(5);
  const std::array<Vec3, 4> places{Vec3(0.02, 0.0, 0.058), Vec3(-0.05, 0.07, 0.057),
                                   Vec3(0.05, -0.08, -0.058), Vec3(0.08, 0.04, 0.057)};
  for (const Vec3& place : places) {
    scene.add_sphere(place, 0.05, 500.0, kWire);
    scene.state.velocity.back() = Vec3(0.3 * random.in_cube(1.0) - Vec3(0.0, 0.0, 3.0 * place.z()));
  }
  return scene;
}

struct Outcome {
  double drift_linear = 0.0;  // over the first
  double drift_angular = 0.0;
  double error = 0.0;  // J
  double turnover = 0.0;
  double broken = 0.0;  // J
};

/// Breaks six bonds in turn.
Outcome break_in_flight(bool has_facets, double friction, double time_step) {
  const Scene scene = flying(has_facets, friction);
  BreakingSimulation simulation(scene,
                                {.time_step = time_step, .motion = {.gravity = Vec3::Zero()}});
  const auto before = momenta_of(simulation);
  constexpr double kUntil = 6e-3;  // s
  const auto steps = static_cast<std::int64_t>(std::round(kUntil / time_step));
  test::Random random(9);
  std::size_t next = 0;
  Outcome outcome;
  while (simulation.steps() < steps) {
    if (simulation.steps() * 7 >= static_cast<std::int64_t>(next + 1) * steps) {
      simulation.break_bond(random.index(scene.bonds.size()));
      ++next;
    }
    simulation.step();
    const auto now = momenta_of(simulation);
    outcome.drift_linear = std::max(outcome.drift_linear, (now.linear - before.linear).norm());
    outcome.drift_angular = std::max(outcome.drift_angular, (now.angular - before.angular).norm());
    const Energy energy = simulation.energy();
    outcome.error = std::max(outcome.error, std::abs(energy.closure_error()));
    outcome.turnover = std::max(outcome.turnover, energy.turnover());
    outcome.broken = energy.bond_dissipated;
  }
  outcome.drift_linear /= before.linear.norm();
  outcome.drift_angular /= before.angular.norm();
  return outcome;
}

class BreakEnergy : public testing::TestWithParam<bool> {};

TEST_P(BreakEnergy, BothMomentaStayThroughBreaks) {
  const Outcome outcome = break_in_flight(GetParam(), 0.5, 2e-6);

  EXPECT_LE(outcome.drift_linear, 1e-10);
  EXPECT_LE(outcome.drift_angular, 1e-10);
}

TEST_P(BreakEnergy, TheLedgerClosesThroughBreaks) {
  // The spring of a contact that is over is lost as it was in the step before: first order.
  const Outcome outcome = break_in_flight(GetParam(), 0.5, 2e-6);

  EXPECT_GT(outcome.broken, 1e-2 * outcome.turnover);
  EXPECT_LE(outcome.error, 1e-4 * outcome.turnover);
}

TEST_P(BreakEnergy, TheErrorFallsWithTheSquareOfTheStepWithoutFriction) {
  const Outcome coarse = break_in_flight(GetParam(), 0.0, 2e-6);
  const Outcome fine = break_in_flight(GetParam(), 0.0, 5e-7);

  EXPECT_GT(coarse.broken, 1e-2 * coarse.turnover);
  // 1/16, times what it makes where in a step breaks and contacts fall; 1/4 in first order.
  EXPECT_LE(fine.error, 0.12 * coarse.error);
}

INSTANTIATE_TEST_SUITE_P(Of, BreakEnergy, testing::Bool(),
                         [](const auto& item) { return item.param ? "AMembrane" : "ANet"; });

TEST(BreakEnergy, WhatABondHadStoredIsDissipated) {
  // Two lumps on a bar of 1 m, 1 % longer than at rest and not moving: EA e² / (2 L0).
  Scene scene;
  scene.materials = {{1e6, 0.5, 0.5}};
  const NodeId a = scene.add_node(Vec3::Zero());
  const NodeId b = scene.add_node(Vec3::UnitX());
  scene.add_beam(a, b, circular_section(0.01, 1e7, 0.3), 1000.0);
  scene.add_cylinder(a, b, 0.01, kWire);
  scene.state.position[1].x() = 1.01;
  BreakingSimulation simulation(scene, {.time_step = 1e-7, .motion = {.gravity = Vec3::Zero()}});
  const double stored = simulation.energy().bond_elastic;

  simulation.break_bond(0);
  EXPECT_EQ(simulation.energy().bond_elastic, stored);  // until the next step
  simulation.step();

  EXPECT_EQ(simulation.energy().bond_elastic, 0.0);
  EXPECT_DOUBLE_EQ(simulation.energy().bond_dissipated, stored);
  EXPECT_EQ(simulation.energy().kinetic, 0.0);
  EXPECT_LE(std::abs(simulation.energy().closure_error()), 1e-15 * stored);
}

/// One element that flies by itself, ever further stretched, bent and twisted.
Scene lone(bool is_facet, double strength) {
  Scene scene;
  scene.materials = {{1e6, 0.5, 0.5}};
  const std::array<Vec3, 3> places{Vec3::Zero(), Vec3::UnitX(), Vec3(0.2, 0.9, 0.1)};
  for (int i = 0; i < (is_facet ? 3 : 2); ++i) scene.add_node(places[static_cast<std::size_t>(i)]);
  if (is_facet) {
    SheetSection section = solid_sheet(0.05, 1e7, 0.3);
    section.strength = strength;
    scene.add_facet(NodeId{0}, NodeId{1}, NodeId{2}, 0.02, kWire);
    scene.add_sheet_facet({NodeId{0}, NodeId{1}, NodeId{2}}, section, 1000.0);
  } else {
    scene.add_cylinder(NodeId{0}, NodeId{1}, 0.02, kWire);
    scene.add_beam(NodeId{0}, NodeId{1}, circular_section(0.05, 1e7, 0.3), 1000.0);
    BondStrength law;
    law.strength = strength;
    if (strength < BondStrength::kNever) scene.bond_laws.push_back({law, {0}});
  }
  test::Random random(3);
  for (std::size_t i = 0; i < scene.state.size(); ++i) {
    scene.state.velocity[i] = scene.state.position[i] + random.in_cube(0.2);
    scene.state.angular_velocity[i] = random.in_cube(0.5);
  }
  return scene;
}

/// By how much the balance changes in the step of the break (J), over what goes through.
double made_by_break(const Scene& scene, double time_step, bool is_asked) {
  BreakingSimulation simulation(scene,
                                {.time_step = time_step, .motion = {.gravity = Vec3::Zero()}});
  double before = 0.0;
  while (simulation.energy().bond_dissipated == 0.0 && simulation.steps() < 1000) {
    before = simulation.energy().closure_error();
    if (is_asked && simulation.steps() == 20) {
      if (scene.bonds.empty())
        simulation.break_facet({NodeId{0}, NodeId{1}, NodeId{2}});
      else
        simulation.break_bond(0);
    }
    simulation.step();
  }
  const Energy energy = simulation.energy();
  EXPECT_GT(energy.bond_dissipated, 1e-3 * energy.turnover());
  EXPECT_EQ(energy.bond_elastic + energy.sheet_elastic, 0.0);
  return std::abs(energy.closure_error() - before) / energy.turnover();
}

// The forces of before act for half of the way to the place of the break. Steps are long, so that
// the energy there is far from the mean of before and after.
TEST(BreakEnergy, NothingIsMadeInTheStepOfABreakHoweverLongItIs) {
  constexpr double kRounding = 100.0 * std::numeric_limits<double>::epsilon();
  for (const bool is_facet : {false, true}) {
    const double critical =
        BreakingSimulation(lone(is_facet, BondStrength::kNever), {}).critical_step().dt;
    for (const bool is_asked : {false, true}) {
      const Scene scene = lone(is_facet, is_asked ? BondStrength::kNever : is_facet ? 3e4 : 5e4);
      EXPECT_LE(made_by_break(scene, 0.3 * critical, is_asked), kRounding) << is_facet << is_asked;
    }
  }
}

TEST(BreakEnergy, WhatAContactOnABrokenCylinderHadStoredIsLostInTracking) {
  // A held ball on a held chain, pressed and dragged along it: normal and tangential energy.
  Scene scene;
  scene.materials = {{1e6, 0.5, 0.6}};
  for (int i = 0; i < 2; ++i) scene.add_node(Vec3(i, 0.0, 0.0), Held::everything);
  scene.add_beam(NodeId{0}, NodeId{1}, circular_section(0.01, 1e7, 0.3), 1000.0);
  scene.add_cylinder(NodeId{0}, NodeId{1}, 0.01, kWire);
  scene.add_sphere(Vec3(0.5, 0.0, 0.059), 0.05, 1000.0, kWire);
  scene.properties.held.back() = Held::everything;
  scene.state.velocity.back() = Vec3(0.01, 0.0, 0.0);
  BreakingSimulation simulation(scene, {.time_step = 1e-5, .motion = {.gravity = Vec3::Zero()}});
  for (int i = 0; i < 100; ++i) simulation.step();
  const Energy before = simulation.energy();
  ASSERT_GT(before.contact_elastic, 0.0);

  simulation.break_bond(0);
  simulation.step();

  const Energy after = simulation.energy();
  EXPECT_EQ(after.contact_elastic, 0.0);
  EXPECT_EQ(before.tracking, 0.0);
  EXPECT_NEAR(after.tracking, before.contact_elastic, 1e-12 * before.contact_elastic);
  EXPECT_EQ(after.friction, before.friction);
}

TEST(BreakEnergy, AContactThatABreakSplitsStoresMoreAndTheLedgerSaysSo) {
  // A held ball on the middle one of three held wires. It is pressed once, by the wire, and then by
  // the ends of the other two, each a contact: k u^2 / 2 with the overlaps of these.
  constexpr double kLength = 0.02, kHeight = 0.055, kRange = 0.06;
  Scene scene;
  scene.materials = {{1e6, 0.5, 0.0}};
  for (int i = 0; i < 4; ++i) scene.add_node(Vec3(kLength * i, 0.0, 0.0), Held::everything);
  for (int i = 0; i < 3; ++i) {
    scene.add_beam(NodeId{i}, NodeId{i + 1}, circular_section(0.01, 1e7, 0.3), 1000.0);
    scene.add_cylinder(NodeId{i}, NodeId{i + 1}, 0.01, kWire);
  }
  scene.add_sphere(Vec3(1.5 * kLength, 0.0, kHeight), kRange - 0.01, 1000.0, kWire);
  scene.properties.held.back() = Held::everything;
  BreakingSimulation simulation(scene, {.time_step = 1e-5, .motion = {.gravity = Vec3::Zero()}});
  simulation.step();
  const Energy before = simulation.energy();

  simulation.break_bond(1);
  simulation.step();

  const Energy after = simulation.energy();
  const double above_wire = kRange - kHeight;
  const double above_ends = kRange - std::hypot(kHeight, 0.5 * kLength);
  const double growth = 2.0 * std::pow(above_ends / above_wire, 2);
  EXPECT_EQ(simulation.contacts().counts().sphere_surface, 2u);
  EXPECT_NEAR(after.contact_elastic, growth * before.contact_elastic,
              1e-12 * before.contact_elastic);
  EXPECT_NEAR(after.tracking, before.contact_elastic - after.contact_elastic,
              1e-12 * before.contact_elastic);
  EXPECT_LT(after.tracking, 0.0);
  EXPECT_EQ(after.friction, 0.0);
}

/// A held ring of six wires in the plane z = 0, of 0.05 m from its middle to each node, and a held
/// ball above the middle that touches all of it.
Scene ball_on_a_ring(double height) {
  constexpr int kLinks = 6;
  Scene scene;
  scene.materials = {{1e6, 0.5, 0.0}};
  for (int i = 0; i < kLinks; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kLinks;
    scene.add_node(0.05 * Vec3(std::cos(angle), std::sin(angle), 0.0), Held::everything);
  }
  for (int i = 0; i < kLinks; ++i) {
    const NodeId a{i}, b{(i + 1) % kLinks};
    scene.add_beam(a, b, circular_section(0.01, 1e7, 0.3), 1000.0);
    scene.add_cylinder(a, b, 0.01, kWire);
  }
  scene.add_sphere(Vec3(0.0, 0.0, height), 0.05, 1000.0, kWire);
  scene.properties.held.back() = Held::everything;
  return scene;
}

TEST(BreakEnergy, ALinkOfARingThatHoldsASphereTakesItsOwnEnergyWithTheSignOfWhatIsLeft) {
  // Nothing moves, so all that changes is what contacts store; the ledger says how much, and which
  // way. Of these two heights the break loses energy at one and makes it at the other, or does the
  // same at both: either way the sign is that of the contacts.
  for (const double height : {0.03, 0.038}) {
    BreakingSimulation simulation(ball_on_a_ring(height),
                                  {.time_step = 1e-5, .motion = {.gravity = Vec3::Zero()}});
    simulation.step();
    const Energy before = simulation.energy();
    ASSERT_GT(before.contact_elastic, 0.0);
    ASSERT_EQ(before.tracking, 0.0);

    simulation.break_bond(0);
    simulation.step();

    const Energy after = simulation.energy();
    EXPECT_NE(after.tracking, 0.0) << height;
    EXPECT_NEAR(after.tracking, before.contact_elastic - after.contact_elastic,
                1e-12 * before.contact_elastic)
        << height;
    EXPECT_EQ(after.friction, 0.0) << height;
    EXPECT_LE(std::abs(after.closure_error()), 1e-12 * before.contact_elastic) << height;
  }
}

TEST(BreakEnergy, TrackingIsNothingWhereOneContactGoesOverFlatFacets) {
  // A ball rolls with friction over the seams of a flat net of facets: one contact all the way.
  Scene scene;
  scene.materials = {{1e6, 0.5, 0.6}};
  test::NetOptions net;
  net.has_facets = true;
  net.has_cylinders = false;
  net.inside = Held::everything;
  test::add_net(scene, net);
  scene.add_sphere(Vec3(-0.15, 0.013, 0.0598), 0.05, 2000.0, kWire);
  scene.state.velocity.back() = Vec3(1.0, 0.1, 0.0);
  BreakingSimulation simulation(scene,
                                {.time_step = 1e-5, .motion = {.gravity = Vec3(0, 0, -9.81)}});
  for (int i = 0; i < 25000; ++i) simulation.step();

  const Energy energy = simulation.energy();
  EXPECT_GT(simulation.state().position.back().x(), 0.0);  // over six seams
  EXPECT_GT(energy.friction, 0.0);
  EXPECT_LT(std::abs(energy.tracking), 1e-6 * energy.turnover());
}

}  // namespace
}  // namespace plekton::dynamics::break_energy_test
