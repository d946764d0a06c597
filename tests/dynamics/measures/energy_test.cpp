// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/energy.hpp"

#include "dynamics/simulation.hpp"
#include "tests/support/beam_structure.hpp"
#include "tests/support/complexes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace plekton::test::energy_test {
namespace {

using dynamics::Held;
using dynamics::Simulation;

constexpr contact::MaterialId kMaterial{0};
const Vec3 kGravity(0.0, 0.0, -9.81);
/// In parts of the chosen step, at which the error is 4e-3 of the turnover: the grain gets all its
/// energy in one contact, of which the moments of touching and leaving fall anywhere in a step.
constexpr double kStepUnderPlanes = 0.25;

struct Trial {
  Scene scene;
  dynamics::MotionOptions motion;
  double duration;  // s
};

/// Largest closure error of the ledger at any step over the largest turnover.
double closure_of(const Trial& trial, double time_step) {
  dynamics::SimulationOptions options;
  options.time_step = time_step;
  options.motion = trial.motion;
  Simulation simulation(trial.scene, options);
  double error = 0.0;
  double turnover = 0.0;
  while (simulation.time() < trial.duration) {
    simulation.step();
    const dynamics::Energy energy = simulation.energy();
    error = std::max(error, std::abs(energy.closure_error()));
    turnover = std::max(turnover, energy.turnover());
  }
  return error / turnover;
}

double chosen_step(const Trial& trial) {
  dynamics::SimulationOptions options;
  options.motion = trial.motion;
  return Simulation(trial.scene, options).time_step();
}

/// The books close to 1e-3 of the turnover at every step, and a step of a quarter brings the error
/// to a quarter, as for any method of first order, or to less. The margin of 1.2 is for terms of
/// higher order and for the moments of contact, which fall on other parts of a step.
/// @param time_step  s, where the ledger closes
void expect_closed_books(const Trial& trial, double time_step) {
  const double coarse = closure_of(trial, time_step);
  const double fine = closure_of(trial, 0.25 * time_step);

  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(fine, 1.2 * coarse / 4.0);
}

Scene one_grain(double friction_angle, const Vec3& centre) {
  Scene scene;
  scene.materials = {{1e6, 0.3, std::tan(friction_angle)}};
  scene.add_sphere(centre, 0.01, 2650.0, kMaterial);
  return scene;
}

/// A sheet of 4 x 4 cells of 25 mm in z = 0, held at its rim.
void add_sheet(Scene& scene) {
  constexpr int kCells = 4;
  const Complex grid = sheet(kCells);
  const std::size_t first = scene.state.size();
  const auto at = [&](NodeId node) { return geometry::id_at<NodeId>(first + index_of(node)); };
  for (const Vec3& x : grid.x) {
    const bool on_rim = x.head<2>().minCoeff() <= 0.0 || x.head<2>().maxCoeff() >= kCells;
    scene.add_node(0.025 * (x - Vec3(0.5 * kCells, 0.5 * kCells, 0.0)),
                   on_rim ? Held::everything : Held::nothing);
  }
  for (const auto& facet : grid.facets) {
    scene.add_facet(at(facet.nodes[0]), at(facet.nodes[1]), at(facet.nodes[2]), 0.002, kMaterial);
  }
  const geometry::Surface surface({}, scene.elements.facets, scene.state.size());
  for (std::size_t e = 0; e < surface.edge_count(); ++e) {
    const auto& [a, b] = surface.nodes_of(geometry::id_at<geometry::EdgeId>(e));
    scene.add_beam(a, b, dynamics::circular_section(0.002, 2e7, 0.3), 600.0);
  }
}

/// A grain that slides and rolls over a sheet, into which it falls.
Trial grain_on_sheet(double damping) {
  Trial trial{one_grain(0.5, Vec3(-0.021, 0.004, 0.0125)), {kGravity, damping, true}, 0.06};
  trial.scene.state.velocity[0] = Vec3(0.6, 0.1, -0.3);
  add_sheet(trial.scene);
  return trial;
}

TEST(EnergyLedger, ClosesWhenAPlaneStrikesAGrain) {
  Trial trial{one_grain(0.4, Vec3(0.0, 0.0, 0.0101)), {}, 0.01};
  // It comes from below and to the side: it does work against the elastic force and the friction.
  trial.scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3(0.3, 0.0, 0.5), kMaterial});

  expect_closed_books(trial, kStepUnderPlanes * chosen_step(trial));
}

TEST(EnergyLedger, ClosesWhenAGrainRestsOnALiftInGravity) {
  Trial trial{one_grain(0.4, Vec3(0.0, 0.0, 0.00999)), {kGravity}, 0.02};
  trial.scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3(0.0, 0.0, 1.0), kMaterial});

  expect_closed_books(trial, kStepUnderPlanes * chosen_step(trial));
}

TEST(EnergyLedger, ClosesWhenHeldNodesMoveAndTurn) {
  Trial trial{chain(8, 0.2, dynamics::circular_section(0.003, 1e7, 0.3)), {kGravity}, 0.05};
  trial.scene.materials = {{1e6, 0.3, 0.4}};
  for (const std::size_t end : {std::size_t{0}, trial.scene.state.size() - 1}) {
    trial.scene.properties.held[end] = Held::everything;
  }
  trial.scene.state.velocity.front() = Vec3(-0.1, 0.0, 0.3);
  trial.scene.state.angular_velocity.back() = Vec3(0.0, 2.0, 0.0);

  expect_closed_books(trial, chosen_step(trial));
}

TEST(EnergyLedger, ClosesWhenAGrainRubsOnASheet) {
  const Trial trial = grain_on_sheet(0.0);

  dynamics::SimulationOptions options;
  options.motion = trial.motion;
  Simulation simulation(trial.scene, options);
  while (simulation.time() < trial.duration) simulation.step();
  const dynamics::Energy energy = simulation.energy();
  EXPECT_GT(energy.friction, 0.05 * energy.turnover());
  EXPECT_GT(energy.bond_elastic, 0.0);

  expect_closed_books(trial, chosen_step(trial));
}

TEST(EnergyLedger, ClosesWhenGrainAndSheetAreDamped) {
  const Trial trial = grain_on_sheet(0.3);

  dynamics::SimulationOptions options;
  options.motion = trial.motion;
  Simulation simulation(trial.scene, options);
  while (simulation.time() < trial.duration) simulation.step();
  const dynamics::Energy energy = simulation.energy();
  EXPECT_GT(energy.damping, 0.05 * energy.turnover());

  expect_closed_books(trial, chosen_step(trial));
}

TEST(EnergyLedger, HoldsTheWorkOfAPlaneThatStrikesAFreeGrain) {
  constexpr double kSpeed = 0.5;  // m/s
  Scene scene = one_grain(0.0, Vec3(0.0, 0.0, 0.0101));
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3(0.0, 0.0, kSpeed), kMaterial});
  dynamics::SimulationOptions options;
  options.time_step = chosen_step({scene, {}, 0.0}) / 16.0;
  Simulation simulation(scene, options);

  while (simulation.time() < 0.01) simulation.step();

  // Without friction and gravity the grain leaves at twice the speed of the plane, and all it has
  // got is the work of the plane.
  const dynamics::Energy energy = simulation.energy();
  const double expected = 0.5 * simulation.properties().mass[0] * std::pow(2.0 * kSpeed, 2);
  EXPECT_EQ(simulation.contacts().counts().with_planes, 0u);
  EXPECT_NEAR(energy.kinetic, expected, 1e-3 * expected);
  EXPECT_NEAR(energy.external_work, expected, 1e-3 * expected);
}

// Whatever the step: what is left are the roundings of the sum.
TEST(Energy, BalancesUnderALoadThatIsThereAtOnce) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.3}};
  scene.add_sphere(Vec3::Zero(), 0.05, 2650.0, contact::MaterialId{0});
  scene.state.velocity[0] = Vec3(0.3, 0.0, 0.0);
  scene.loads.forces.push_back({{NodeId{0}}, Vec3(40.0, 0.0, 15.0), Vec3(0.0, 0.2, 0.0), {}});
  Simulation simulation(scene, {.time_step = 1e-3, .motion = {.gravity = Vec3(0, 0, -9.81)}});

  for (int i = 0; i < 200; ++i) {
    simulation.step();
    const dynamics::Energy energy = simulation.energy();
    EXPECT_NEAR(energy.closure_error(), 0.0, 1e-13 * (energy.turnover() + energy.external_work));
  }
}

// The balance is taken between drifts of 1 and 0.01 ms.
TEST(Energy, BalancesWhereTheStepHasJustBecomeShort) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.3}};
  scene.add_sphere(Vec3::Zero(), 0.05, 2650.0, contact::MaterialId{0});
  scene.loads.forces.push_back({{NodeId{0}}, Vec3(40.0, 0.0, 0.0), Vec3::Zero(), {}});
  Simulation simulation(scene, {.time_step = 1e-3, .motion = {}});

  for (int i = 0; i < 20; ++i) simulation.step();
  simulation.set_time_step(1e-5);
  simulation.step();

  // Kinetic energy as the leapfrog has it is below the true one by 1/2 m (a dt / 2)², which is
  // that of another step now.
  const double mass = simulation.properties().mass[0];
  EXPECT_NEAR(simulation.energy().closure_error(), 0.5 * mass * std::pow(40.0 / mass * 5e-4, 2),
              1e-3 * 0.5 * mass * std::pow(40.0 / mass * 5e-4, 2));
}

TEST(Energy, HasNoClosureWhereNothingHasHappened) {
  EXPECT_EQ(dynamics::Energy{}.closure(), 0.0);
}

/// Friction of -3 J is energy that was made, and an attraction stores less than nothing.
TEST(Energy, HasAClosureWhereWhatIsNegativeOutweighsTheRest) {
  dynamics::Energy energy;
  energy.kinetic = 1.0;
  energy.contact_elastic = -0.5;
  energy.friction = -3.0;
  energy.initial = 0.5;

  EXPECT_EQ(energy.closure_error(), -3.0);
  EXPECT_EQ(energy.turnover(), 4.5);
  EXPECT_EQ(energy.closure(), 3.0 / 4.5);
}

/// At its highest point a ball has only energy of position: the error is one of the way there.
TEST(Energy, HasAClosureOverTheLargestTurnoverOfAllTimes) {
  dynamics::Energy energy;
  energy.kinetic = 0.25;
  energy.gravity = -0.75;

  EXPECT_EQ(energy.closure(), 2.0);
  EXPECT_EQ(energy.closure(10.0), 0.05);
}

TEST(Energy, HasNoClosureWhereASheetRattlesInItsLastDigits) {
  for (const double offset : {0.0, 1000.0}) {
    Scene scene;
    scene.materials = {{1e6, 0.3, 0.4}};
    add_sheet(scene);
    for (Vec3& x : scene.state.position) x += Vec3(offset, 0.3 * offset, -offset);
    for (dynamics::BeamBond& bond : scene.bonds) {  // at rest where they are now
      bond = dynamics::make_beam(bond.nodes[0], bond.nodes[1], scene.state, bond.section);
    }
    Simulation simulation(scene, {});

    for (int i = 0; i < 2000; ++i) simulation.step();

    EXPECT_EQ(simulation.energy().closure(), 0.0) << "at " << offset << " m";
    EXPECT_LT(simulation.energy().turnover(), 1e-8);
  }
}

TEST(Energy, TakesNoRealErrorForRounding) {
  const Trial trial = grain_on_sheet(0.0);
  dynamics::SimulationOptions options;
  options.motion = trial.motion;
  Simulation simulation(trial.scene, options);

  while (simulation.time() < trial.duration) simulation.step();

  const dynamics::Energy energy = simulation.energy();
  EXPECT_LT(energy.rounding, 1e-9 * energy.turnover());
  EXPECT_GT(energy.closure(), 0.0);
}

/// A shell that is held and moved: the work of pressure on one side is taken back on the other, and
/// what is left of 1 J is rounding, as all else that its nodes do.
TEST(Energy, TakesWhatIsLeftOfWorkThatCancelsForRounding) {
  Scene scene;
  scene.materials = {{1e7, 0.3, 0.5}};
  for (const Vec3& x :
       {Vec3(0.0, 0.0, 0.0), Vec3(0.1, 0.0, 0.01), Vec3(0.0, 0.1, 0.02), Vec3(0.03, 0.02, 0.1)}) {
    scene.add_node(x, Held::translation);
    scene.state.velocity.back() = Vec3(-0.4177, 0.5227, 0.3655);
  }
  constexpr double kRadius = 1e-3;
  for (const auto& [a, b] :
       std::vector<std::pair<int, int>>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}) {
    scene.add_beam(NodeId{a}, NodeId{b}, dynamics::circular_section(kRadius, 7e8, 0.3), 1000.0);
    scene.add_cylinder(NodeId{a}, NodeId{b}, kRadius, kMaterial);
  }
  dynamics::SurfacePressure pressure;
  pressure.pressure = 1e4;
  for (const auto& [a, b, c] :
       std::vector<std::array<int, 3>>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
    scene.add_facet(NodeId{a}, NodeId{b}, NodeId{c}, kRadius, kMaterial);
    pressure.facets.push_back(geometry::id_at<geometry::FaceId>(pressure.facets.size()));
  }
  scene.loads.pressures.push_back(pressure);
  dynamics::SimulationOptions options;
  options.motion.gravity = Vec3::Zero();
  Simulation simulation(scene, options);
  for (int i = 0; i < 400; ++i) simulation.step();

  EXPECT_EQ(simulation.energy().closure(), 0.0) << simulation.energy().closure_error() << " J";
  EXPECT_LT(simulation.energy().rounding, 1e-12);
}

// Bars of a net that is turned as a whole: 1e-20 J of work on 1e-31 J in them were 1e12 %.
TEST(Energy, TakesTheWorkOfBarsThatRoundingStretchesForRounding) {
  Scene scene;
  scene.materials = {{1e7, 0.3, 0.5}};
  for (const Vec3& x : {Vec3(0.03, -0.01, 0.02), Vec3(0.05, 0.01, 0.01), Vec3(0.02, 0.03, 0.0)})
    scene.add_node(x, Held::translation);
  for (int i = 0; i < 3; ++i)
    scene.add_beam(NodeId{i}, NodeId{(i + 1) % 3}, dynamics::circular_section(1e-3, 7e8, 0.3),
                   1000.0);
  for (std::size_t i = 0; i < 3; ++i)
    scene.state.velocity[i] = Vec3(-0.7, -0.6, -0.3).cross(scene.state.position[i]);
  dynamics::SimulationOptions options;
  options.motion.gravity = Vec3::Zero();
  options.time_step = 1e-9;  // hardly any way, so that they are not stretched by it
  Simulation simulation(scene, options);
  for (int i = 0; i < 100; ++i) simulation.step();

  EXPECT_EQ(simulation.energy().closure(), 0.0) << simulation.energy().closure_error() << " J";
}

}  // namespace
}  // namespace plekton::test::energy_test
