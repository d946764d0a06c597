// SPDX-License-Identifier: GPL-3.0-or-later
// What becomes of structures that fall apart, and of what acts on them.
#include "dynamics/loads/applied_loads.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/time_step/motion_step.hpp"
#include "tests/support/breaking_net.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace plekton::dynamics::break_pieces_test {
namespace {

using test::BreakingSimulation;
using test::kMesh;
using test::kWire;
using test::kWireRadius;

/// A straight free chain along x, and its simulation without gravity.
Scene free_chain(int bonds, double length) {
  Scene scene;
  scene.materials = {{1e6, 0.5, 0.5}};
  for (int i = 0; i <= bonds; ++i) {
    scene.add_node(Vec3(length * i, 0.0, 0.0));
    if (i == 0) continue;
    scene.add_beam(NodeId{i - 1}, NodeId{i}, circular_section(kWireRadius, 1e8, 0.3), 1000.0);
    scene.add_cylinder(NodeId{i - 1}, NodeId{i}, kWireRadius, kWire);
  }
  return scene;
}

SimulationOptions weightless(double time_step = 0.0) {
  SimulationOptions options;
  options.time_step = time_step;
  options.motion.gravity = Vec3::Zero();
  return options;
}

TEST(BreakPieces, NothingMovesWhenAChainAtRestBreaks) {
  // Also where cylinders are shorter than thick, so that the two ends overlap.
  for (const double length : {0.1, 0.012}) {
    const Scene scene = free_chain(6, length);
    BreakingSimulation simulation(scene, weightless());
    for (const std::size_t bond : {2U, 3U, 0U}) {
      simulation.break_bond(bond);
      for (int i = 0; i < 200; ++i) simulation.step();
    }

    EXPECT_EQ(simulation.state().position, scene.state.position);
    EXPECT_EQ(simulation.elements().cylinders.size(), 3u);
    EXPECT_EQ(simulation.surface().structure_of(NodeId{0}), geometry::StructureId{-1});
  }
}

TEST(BreakPieces, ANodeWithoutElementsTouchesAPlaneAsOfItsStructure) {
  // All bonds of a chain that lies on a plane are gone, and only nodes are left.
  Scene scene = free_chain(3, kMesh);
  scene.planes.push_back({Vec3(0.0, 0.0, -0.99 * kWireRadius), Vec3::UnitZ(), Vec3::Zero(), kWire});
  BreakingSimulation simulation(scene, weightless());
  for (const std::size_t bond : {0U, 1U, 2U}) simulation.break_bond(bond);
  simulation.step();
  simulation.step();

  const std::vector<contact::ContactRecord> records = simulation.contact_rows();
  ASSERT_EQ(records.size(), 4U);
  for (const contact::ContactRecord& record : records) {
    EXPECT_EQ(record.a.kind, contact::BodyKind::structure);
    EXPECT_EQ(record.a.index, 0);
    EXPECT_EQ(record.a.feature.kind, geometry::FeatureKind::node);
  }
}

TEST(BreakPieces, PiecesOfAChainTouchEachOtherUnlessStructuresDoNotTouchThemselves) {
  // A piece of two cylinders flies along x at another, 0.1 m away.
  for (const bool self_contact : {true, false}) {
    Scene scene = free_chain(5, kMesh);
    for (const int node : {0, 1, 2}) scene.state.velocity[static_cast<std::size_t>(node)].x() = 1.0;
    SimulationOptions options = weightless();
    options.self_contact = self_contact;
    BreakingSimulation simulation(scene, options);
    simulation.break_bond(2);

    std::size_t touched = 0;
    while (simulation.time() < 0.15) {
      simulation.step();
      touched += simulation.contacts().counts().between_structures;
    }

    EXPECT_EQ(touched > 0, self_contact);
    EXPECT_EQ(simulation.state().position[2].x() < simulation.state().position[3].x(),
              self_contact);
    EXPECT_EQ(simulation.state().velocity[4].x() > 0.0, self_contact);
  }
}

TEST(BreakPieces, ANodeThatLostItsLastElementFallsAndLiesOnTheFloorUntouchedByOthers) {
  Scene scene = free_chain(2, kMesh);
  scene.planes.push_back({Vec3(0.0, 0.0, -0.02), Vec3::UnitZ(), Vec3::Zero(), kWire});
  // Held above the node: it does not touch what has no shape.
  scene.add_sphere(Vec3(0.0, 0.0, 0.049), 0.05, 1000.0, kWire);
  scene.properties.held.back() = Held::everything;
  for (const std::size_t node : {1U, 2U}) scene.properties.held[node] = Held::everything;
  scene.properties.held[0] = Held::everything;
  BreakingSimulation still(scene, weightless(1e-5));
  still.step();
  ASSERT_EQ(still.contacts().counts().sphere_surface, 1u);

  scene.properties.held[0] = Held::nothing;
  SimulationOptions options;
  options.motion.gravity = Vec3(0.0, 0.0, -9.81);
  options.motion.damping = 0.3;
  BreakingSimulation simulation(scene, options);
  const double mass = simulation.properties().mass[0];
  simulation.break_bond(0);
  simulation.step();
  EXPECT_EQ(simulation.contacts().counts().sphere_surface, 0u);
  while (simulation.time() < 0.5) simulation.step();

  EXPECT_EQ(simulation.properties().mass[0], mass);
  EXPECT_NEAR(simulation.state().position[0].z(), -0.01, 1e-4);
  EXPECT_LT(simulation.state().velocity[0].norm(), 1e-3);
}

TEST(BreakPieces, OnlyBondsThatExistBreakAndEachOnce) {
  BreakingSimulation simulation(free_chain(3, kMesh), weightless());
  EXPECT_THROW(simulation.break_bond(3), std::out_of_range);

  simulation.break_bond(1);
  simulation.break_bond(1);
  simulation.step();
  simulation.break_bond(1);
  simulation.step();

  EXPECT_TRUE(simulation.bonds().is_broken(1));
  EXPECT_EQ(simulation.elements().cylinders.size(), 2u);
}

/// A tetrahedron of four facets with bonds along its sides, under pressure.
Scene pressed_tetrahedron(bool has_gas) {
  Scene scene;
  scene.materials = {{1e6, 0.5, 0.5}};
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
    scene.add_node(x);
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}})
    scene.add_beam(NodeId{a}, NodeId{b}, circular_section(0.01, 1e8, 0.3), 1000.0);
  SurfacePressure load;
  load.pressure = 100.0;
  if (has_gas) load.gas = Gas{};
  for (const auto& [a, b, c] : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
    load.facets.push_back(geometry::id_at<geometry::FaceId>(scene.elements.facets.size()));
    scene.add_facet(NodeId{a}, NodeId{b}, NodeId{c}, 0.01, kWire);
  }
  scene.loads.pressures.push_back(load);
  return scene;
}

Vec3 sum(const std::vector<Vec3>& vectors) {
  Vec3 total = Vec3::Zero();
  for (const Vec3& vector : vectors) total += vector;
  return total;
}

TEST(BreakPieces, PressureGoesOnOnTheFacetsThatAreLeft) {
  const Scene scene = pressed_tetrahedron(false);
  BreakingSimulation simulation(scene, weightless(1e-6));
  simulation.step();
  EXPECT_LE(sum(simulation.forces().force).norm(), 1e-11);

  simulation.break_bond(0);  // 0 1: facets 0 and 1 are torn
  simulation.step();

  // p times the area vectors of the other two: (1, 1, 1) / 2 and -(1, 0, 0) / 2.
  EXPECT_LE((sum(simulation.forces().force) - 50.0 * Vec3(0, 1, 1)).norm(), 1e-6);
  for (const std::size_t bond : {1U, 2U, 3U}) simulation.break_bond(bond);
  simulation.step();
  EXPECT_TRUE(simulation.elements().facets.empty());
  EXPECT_LE(sum(simulation.forces().force).norm(), 1e-11);
}

TEST(BreakPieces, AGasEscapesThroughTheFirstTornFacet) {
  const Scene scene = pressed_tetrahedron(true);
  BreakingSimulation simulation(scene, weightless(1e-6));
  for (int i = 0; i < 10; ++i) simulation.step();
  ASSERT_NEAR(simulation.loads().pressed_surfaces()[0].pressure(), 100.0, 0.1);
  const Energy before = simulation.energy();

  simulation.break_bond(0);
  simulation.step();

  EXPECT_EQ(simulation.loads().pressed_surfaces()[0].pressure(), 0.0);
  EXPECT_LE(sum(simulation.forces().force).norm(), 1e-11);
  for (int i = 0; i < 100; ++i) simulation.step();
  EXPECT_LE(std::abs(simulation.energy().closure_error() - before.closure_error()),
            1e-3 * simulation.energy().turnover());
}

TEST(BreakPieces, ABrokenBeamIsNotDampedAnyMore) {
  Scene scene = free_chain(1, kMesh);
  scene.state.velocity[1] = Vec3(1.0, 0.0, 0.0);
  scene.loads.beam_damping.push_back({{0}, 0.5});
  BreakingSimulation simulation(scene, weightless(1e-6));
  simulation.step();
  ASSERT_GT(simulation.forces().force[0].x(), 0.0);

  simulation.break_bond(0);
  simulation.step();

  EXPECT_EQ(simulation.forces().force[0], Vec3(0, 0, 0));
}

TEST(BreakPieces, ABrokenBondHasNoPartInTheCriticalTimeStep) {
  Scene scene = free_chain(3, kMesh);
  scene.bonds[1].section.young_modulus *= 100.0;
  BreakingSimulation simulation(scene, weightless(1e-7));
  const double estimate = simulation.critical_step().dt;

  simulation.break_bond(1);
  simulation.step();

  EXPECT_GT(simulation.critical_step().dt, 5.0 * estimate);
}

/// A wire of 0.1 m that breaks at 5 %, one end of which is pulled away.
Scene pulled_wire() {
  Scene scene = free_chain(1, kMesh);
  const WireCurve curve{{{0.05, 10.0}}};
  scene.bonds[0].section = wire_section(kWireRadius, curve);
  scene.bond_laws.push_back({curve, {0}});
  scene.properties.held = {Held::everything, Held::everything};
  scene.state.velocity[1] = Vec3(1.0, 0.0, 0.0);
  return scene;
}

TEST(BreakPieces, ACylinderGoesInTheStepInWhichItsBondBreaksByItself) {
  BreakingSimulation simulation(pulled_wire(), weightless(1e-5));
  while (!simulation.bonds().is_broken(0)) {
    ASSERT_EQ(simulation.elements().cylinders.size(), 1u);
    ASSERT_LT(simulation.time(), 6e-3);
    simulation.step();
  }

  EXPECT_GT(simulation.time(), 4.9e-3);
  EXPECT_TRUE(simulation.elements().cylinders.empty());
  EXPECT_EQ(simulation.surface().cell_count(), 0u);
}

TEST(BreakPieces, ABondThatIsStretchedTooFarAtTheStartHoldsNothingFromThen) {
  Scene scene = pulled_wire();
  scene.state.position[1].x() *= 1.06;
  const BreakingSimulation simulation(scene, weightless(1e-5));

  EXPECT_TRUE(simulation.elements().cylinders.empty());
  EXPECT_EQ(simulation.energy().bond_dissipated, 0.0);
}

// The step was chosen for what was left, which was nothing: 0.6 radii at a time, into the floor.
TEST(BreakPieces, WhatIsBrokenAtTheStartComesToTheFloorInStepsThatFollowIt) {
  Scene scene = pulled_wire();
  scene.state.position[1].x() *= 1.06;
  scene.planes.push_back({Vec3(0.0, 0.0, -0.05), Vec3::UnitZ(), Vec3::Zero(), kWire});
  scene.properties.held.assign(2, Held::nothing);
  scene.state.velocity.assign(2, Vec3(0.0, 0.0, -3.0));
  BreakingSimulation simulation(scene, weightless());
  ASSERT_TRUE(simulation.elements().cylinders.empty());

  while (simulation.contacts().counts().with_planes == 0) {
    ASSERT_LT(simulation.time(), 0.02);
    ASSERT_LE(simulation.motion_ratio(), 1.000001 * kLargestMotion);
    simulation.step();
  }
  EXPECT_EQ(simulation.contacts().counts().with_planes, 2u);
  EXPECT_LE(simulation.contacts().largest_overlap_ratio(), kLargestMotion);
}

/// Spheres fall on a net whose bonds break in turn.
std::vector<Vec3> broken_under_rain(int threads, bool has_facets) {
  test::Random random(3);
  Scene scene;
  scene.materials = {{1e6, 0.5, 0.5}};
  test::add_net(scene, {.squares = 6, .has_facets = has_facets, .has_cylinders = !has_facets});
  for (int k = 0; k < 60; ++k)
    scene.add_sphere(
        Vec3(0.05, 0.05, 0.0).cwiseProduct(random.in_cube(4.0)) + Vec3(0.0, 0.0, 0.05 + 0.02 * k),
        0.02, 1000.0, kWire);
  SimulationOptions options;
  options.threads = threads;
  BreakingSimulation simulation(scene, options);
  while (simulation.time() < 0.25) {
    if (simulation.steps() % 40 == 39) simulation.break_bond(random.index(scene.bonds.size()));
    simulation.step();
  }
  EXPECT_GT(simulation.contacts().dissipated(), 0.0);
  std::vector<Vec3> outcome = simulation.state().position;
  const Energy energy = simulation.energy();
  outcome.push_back(Vec3(energy.friction, energy.bond_dissipated, energy.kinetic));
  return outcome;
}

TEST(BreakPieces, AnyNumberOfThreadsGivesTheSameBitsThroughBreaks) {
  for (const bool has_facets : {false, true}) {
    const std::vector<Vec3> one = broken_under_rain(1, has_facets);
    EXPECT_EQ(broken_under_rain(2, has_facets), one);
    EXPECT_EQ(broken_under_rain(4, has_facets), one);
  }
}

}  // namespace
}  // namespace plekton::dynamics::break_pieces_test
