// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/ties/ties.hpp"

#include "tests/support/loaded_scene.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace plekton::test::ties_test {
namespace {

using dynamics::Cable;
using dynamics::CablePlace;
using dynamics::FixedPoint;
using dynamics::Held;
using dynamics::material_point;
using dynamics::MaterialPoint;
using dynamics::Tie;

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// Two lumps of 2 kg, 1 m apart, with a tie of 400 N/m: 20 rad/s.
Scene two_lumps() {
  Scene scene;
  const NodeId a = add_lump(scene, Vec3(0.0, 2.0, 3.0));
  const NodeId b = add_lump(scene, Vec3(1.0, 2.0, 3.0));
  scene.ties.push_back(
      {.node = a, .to = material_point(b), .stiffness = 400.0, .rest_length = 1.0});
  return scene;
}

/// A lump that is tied to where it is.
Scene lump_at_a_point(double stiffness) {
  Scene scene;
  const NodeId node = add_lump(scene, Vec3::Zero());
  scene.ties.push_back({.node = node, .to = FixedPoint{Vec3::Zero()}, .stiffness = stiffness});
  return scene;
}

/// A cable of held nodes at these places, with a bead of 2 kg.
Scene bead_on_cable(const std::vector<Vec3>& places, const Vec3& bead, double stiffness) {
  Scene scene;
  Cable cable;
  for (const Vec3& place : places) cable.nodes.push_back(scene.add_node(place, Held::everything));
  const NodeId node = add_lump(scene, bead);
  scene.cables.push_back(cable);
  scene.ties.push_back(
      {.node = node, .to = CablePlace{0, 0, 0.5}, .stiffness = stiffness, .pushes = false});
  return scene;
}

void step_until(LoadedSimulation& simulation, double time) {
  while (simulation.time() < time) simulation.step();
}

TEST(Ties, SwingTwoMassesWithTheirFrequency) {
  Scene scene = two_lumps();
  scene.state.velocity[0].x() = -0.05;
  scene.state.velocity[1].x() = 0.05;
  const double dt = 1e-4;
  auto simulation = simulation_of(scene, dt);

  const double period = 2.0 * std::numbers::pi / 20.0;
  const auto steps = static_cast<int>(std::lround(period / dt));
  for (int i = 0; i < steps; ++i) simulation.step();

  // Back but for the rest of a step and the frequency of the leapfrog, higher by (w dt)²/24.
  const double late = std::abs(steps * dt - period) + period * 400.0 * dt * dt / 24.0;
  EXPECT_NEAR(simulation.state().position[0].x(), 0.0, 1.01 * 0.05 * late);
  EXPECT_NEAR(simulation.state().position[1].x(), 1.0, 1.01 * 0.05 * late);
}

TEST(Ties, KeepTheEnergyToRounding) {
  Scene scene = two_lumps();
  scene.state.velocity[0].x() = -0.1;
  auto simulation = simulation_of(scene, 0.02);

  // A spring along its line is linear: only rounding is left, in each of 500 steps.
  const double work_of_rounding = 400.0 * 0.01 * 3.0 * kEps;  // J: force times rounding of 3 m
  EXPECT_LT(closure_until(simulation, 10.0), 500.0 * 4.0 * work_of_rounding / 0.01);
}

TEST(Ties, SetTheCriticalStepOfWhatTheyHold) {
  EXPECT_DOUBLE_EQ(LoadedSimulation(lump_at_a_point(800.0), {}).critical_step().dt,
                   2.0 / std::sqrt(800.0 / 2.0));
  const LoadedSimulation pair(two_lumps(), {});
  EXPECT_NEAR(pair.critical_step().dt, 2.0 / 20.0, 1e-12);
  EXPECT_NEAR(pair.exact_critical_step().dt, 2.0 / 20.0, 1e-3 * 2.0 / 20.0);
}

/// Ties to a node, to points of a facet and a bar, and to a cable, at a distance, in a cloud of
/// nodes that move.
TEST(Ties, ActOnBothSidesOppositeAndOnOneLine) {
  Scene scene;
  std::vector<NodeId> nodes;
  for (int i = 0; i < 12; ++i) {
    const double t = i;
    nodes.push_back(add_lump(scene, Vec3(std::sin(3.0 * t), std::cos(5.0 * t), std::sin(7.0 * t))));
    scene.state.velocity.back() = Vec3(std::cos(t), std::sin(2.0 * t), std::cos(3.0 * t));
  }
  scene.cables.push_back({{nodes[4], nodes[5], nodes[6], nodes[7]}, false});
  const auto tie = [&](std::size_t node, auto to) {
    scene.ties.push_back(
        {.node = nodes[node], .to = to, .stiffness = 100.0, .rest_length = 0.3, .pushes = false});
  };
  tie(0, material_point(nodes[1]));
  tie(2, MaterialPoint{{nodes[4], nodes[5], nodes[6]}, Vec3(0.2, 0.5, 0.3)});
  tie(3, MaterialPoint{{nodes[8], nodes[9], nodes[8]}, Vec3(0.4, 0.6, 0.0)});
  tie(10, CablePlace{0, 1, 0.5});
  tie(11, CablePlace{0, 2, 0.1});
  scene.ties.back().friction = 0.4;
  auto simulation = simulation_of(scene, 1e-3);

  for (int i = 0; i < 500; ++i) {
    simulation.step();
    const std::vector<Vec3> x = simulation.force_positions();
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    double largest = 0.0;
    for (std::size_t n = 0; n < x.size(); ++n) {
      force += simulation.forces().force[n];
      moment += x[n].cross(simulation.forces().force[n]);
      largest = std::max(largest, simulation.forces().force[n].norm());
    }
    // Each of some 20 terms is rounded once, at most some 3 m from the origin; places of the step
    // before are rounded when they are found again.
    EXPECT_LE(force.norm(), 20.0 * kEps * largest) << i;
    EXPECT_LE(moment.norm(), 200.0 * kEps * largest) << i;
  }
  EXPECT_GT(simulation.ties().pull(4), 0.0);
}

/// y = x² / 2 between -1 m and 1 m in 40 straight pieces.
std::vector<Vec3> parabola() {
  std::vector<Vec3> places;
  for (int i = -20; i <= 20; ++i) {
    const double x = i / 20.0;
    places.emplace_back(x, 0.0, 0.5 * x * x);
  }
  return places;
}

/// What a bead that slides from x = -0.7 m does in 3 s.
struct BeadOnParabola {
  double furthest = -1.0;   ///< m, along x
  double error = 0.0;       ///< J, of the ledger, over the energy of weight at the start
  double dissipated = 0.0;  ///< J
  double slip = 0.0;        ///< m
};

BeadOnParabola slide_on_parabola(double dt) {
  const double x0 = -0.7;
  Scene scene = bead_on_cable(parabola(), Vec3(x0, 0.0, 0.5 * x0 * x0), 1e6);
  scene.ties[0].to = CablePlace{0, 6, 0.0};
  auto simulation = simulation_of(scene, dt, Vec3(0.0, 0.0, -9.81));
  BeadOnParabola bead;
  while (simulation.time() < 3.0) {
    simulation.step();
    bead.furthest = std::max(bead.furthest, simulation.state().position[41].x());
    bead.error = std::max(bead.error, std::abs(simulation.energy().closure_error()));
  }
  bead.error /= 2.0 * 9.81 * 0.5 * x0 * x0;
  bead.dissipated = simulation.ties().dissipated();
  bead.slip = simulation.ties().slip(0);
  return bead;
}

/// At each corner the force turns at once, by k d 0.05 where the bead swings across the cable by d:
/// so the leapfrog is off by that times the way of a step, of either sign, in each of some 200
/// corners, and the less the shorter the step.
TEST(Ties, LetABeadSlideOverManySegmentsWithoutWork) {
  const BeadOnParabola coarse = slide_on_parabola(1e-4);
  const BeadOnParabola fine = slide_on_parabola(1e-5);

  EXPECT_LT(coarse.error, 0.01);
  EXPECT_LT(fine.error, 1e-3);
  // A corner turns at most 0.05² of the energy along the cable into swinging across it; there are 28
  // on the way, and x goes with the root of the height.
  EXPECT_NEAR(fine.furthest, 0.7, 0.5 * 28.0 * 0.05 * 0.05 * 0.7);
  EXPECT_EQ(fine.dissipated, 0.0);
  EXPECT_GT(fine.slip, 2.0);
}

/// A bead of 2 kg that hangs on a level cable of 8 segments under 10 m/s², with 1 m/s along it:
/// 1 J of motion, 20 N across.
Scene sliding_bead(double friction, double slip_force) {
  std::vector<Vec3> places;
  for (int i = 0; i <= 8; ++i) places.emplace_back(0.1 * i, 0.0, 0.0);
  Scene scene = bead_on_cable(places, Vec3(0.05, 0.0, -20.0 / 1e7), 1e7);
  scene.state.velocity.back() = Vec3(1.0, 0.0, 0.0);
  scene.ties[0].friction = friction;
  scene.ties[0].slip_force = slip_force;
  return scene;
}

void expect_stop_after(Scene scene, double force) {
  auto simulation = simulation_of(std::move(scene), 5e-5, Vec3(0.0, 0.0, -10.0));

  const double closure = closure_until(simulation, 1.0);

  // At last it sticks with at most F² / (2 k) in the spring along the cable, and that swings by F / k.
  // The first half of a step is without friction.
  const double spring = force / 1e7;  // m
  const double late = 0.5 * 5e-5;     // m, at 1 m/s
  EXPECT_NEAR(simulation.ties().dissipated(), 1.0, force * (spring + 1.01 * late));
  EXPECT_NEAR(simulation.ties().slip(0), 1.0 / force, 4.0 * spring + 1.01 * late);
  EXPECT_NEAR(simulation.state().position.back().x(), 0.05 + 1.0 / force, 1e-3 / force);
  EXPECT_LT(closure, 1e-4);
}

TEST(Ties, TakeWhatCoulombSaysAsTheySlide) {
  expect_stop_after(sliding_bead(0.15, 0.0), 0.15 * 20.0);
  expect_stop_after(sliding_bead(0.3, 0.0), 0.3 * 20.0);
}

TEST(Ties, SlipAtAConstantForce) {
  expect_stop_after(sliding_bead(0.0, 4.0), 4.0);
  expect_stop_after(sliding_bead(0.1, 2.0), 4.0);
}

/// 2 kg at 3 m/s, 9 J, pull on a brake of 40 N and 1e5 N/m.
Scene braked_lump(double stroke) {
  Scene scene = lump_at_a_point(1e5);
  scene.state.velocity[0] = Vec3(3.0, 0.0, 0.0);
  scene.ties[0].pushes = false;
  scene.ties[0].brake_force = 40.0;
  scene.ties[0].stroke = stroke;
  return scene;
}

TEST(Ties, PayOutAtTheForceOfTheBrake) {
  auto simulation = simulation_of(braked_lump(1.0), 1e-4);

  const double closure = closure_until(simulation, 0.5);

  const double elastic = 40.0 * 40.0 / 2e5;  // J, goes back into motion
  EXPECT_NEAR(simulation.ties().slip(0), (9.0 - elastic) / 40.0, 1e-4);
  EXPECT_NEAR(simulation.ties().dissipated(), 9.0 - elastic, 40.0 * 1e-4);
  EXPECT_LT(simulation.state().velocity[0].x(), 0.0);
  EXPECT_EQ(simulation.ties().pull(0), 0.0);
  EXPECT_LT(closure, 1e-4);
}

TEST(Ties, AreSpringsAgainAfterTheStrokeOfTheBrake) {
  auto simulation = simulation_of(braked_lump(0.1), 1e-4);
  double largest = 0.0;

  for (int i = 0; i < 1000; ++i) {
    simulation.step();
    largest = std::max(largest, simulation.ties().pull(0));
  }

  // 9 J less 40 N times 0.1 m are in the spring at last: F² / (2 k).
  EXPECT_DOUBLE_EQ(simulation.ties().slip(0), 0.1);
  EXPECT_NEAR(largest, std::sqrt(2.0 * 1e5 * (9.0 - 4.0)), 0.01 * largest);
}

TEST(Ties, BreakAtTheirStrengthForGood) {
  Scene scene = lump_at_a_point(1e4);
  scene.state.velocity[0] = Vec3(3.0, 0.0, 0.0);
  scene.ties[0].strength = 200.0;
  auto simulation = simulation_of(scene, 1e-5);

  const double closure = closure_until(simulation, 0.1);

  const double stored = 200.0 * 200.0 / 2e4;  // J
  EXPECT_EQ(simulation.ties().broken(), 1U);
  EXPECT_EQ(simulation.ties().pull(0), 0.0);
  // It breaks in the step in which the force goes above the strength: v k dt beyond it at most.
  EXPECT_NEAR(simulation.ties().dissipated(), stored, 200.0 * 3.0 * 1e-5);
  EXPECT_NEAR(simulation.energy().kinetic, 9.0 - stored, 200.0 * 3.0 * 1e-5);
  EXPECT_LT(closure, 1e-7);
}

// What the brake paid out against the force that broke it was booked too: 5 mJ of 0.8 J.
TEST(Ties, TakeTheirWorkOnceWhereTheBrakeEndsInTheStepInWhichTheyBreak) {
  for (const double dt : {3.7e-5, 4.1e-5, 4.3e-5, 5e-5}) {
    Scene scene = lump_at_a_point(6e5);
    scene.state.velocity[0] = Vec3(6.0, 0.0, 0.0);
    scene.ties[0].pushes = false;
    scene.ties[0].brake_force = 100.0;
    scene.ties[0].stroke = 0.008;
    scene.ties[0].strength = 160.0;
    auto simulation = simulation_of(scene, dt);

    closure_until(simulation, 0.01);

    EXPECT_EQ(simulation.ties().broken(), 1U) << dt;
    const double lost = 0.5 * 2.0 * 36.0 - simulation.energy().kinetic;  // J
    EXPECT_NEAR(simulation.ties().dissipated(), lost, 1e-12 * 36.0) << dt;
  }
}

TEST(Ties, HoldWhatPushesOnlyWhereTheyPush) {
  for (const bool pushes : {true, false}) {
    Scene scene = two_lumps();
    scene.ties[0].pushes = pushes;
    scene.state.velocity[0].x() = 0.1;
    auto simulation = simulation_of(scene, 1e-3);
    step_until(simulation, 0.05);
    EXPECT_EQ(simulation.ties().pull(0) < 0.0, pushes);
    EXPECT_EQ(simulation.state().velocity[1].x() > 0.0, pushes);
  }
}

/// A sheet of two facets that is held, and a lump tied to a point of one of them.
TEST(Ties, BreakWithTheFacetThatTheyHoldTo) {
  Scene scene;
  const auto sheet = geometry::plane_sheet({1.0, 1.0, 2, 2});
  add_membrane(scene, sheet);
  scene.materials.push_back({1e6, 0.3, 0.0});
  for (auto& held : scene.properties.held) held = Held::everything;
  const auto nodes = scene.elements.facets[0].nodes;
  const Vec3 middle =
      (scene.state.position[index_of(nodes[0])] + scene.state.position[index_of(nodes[1])] +
       scene.state.position[index_of(nodes[2])]) /
      3.0;
  const NodeId lump = add_lump(scene, middle + Vec3(0.0, 0.0, -0.1));
  scene.ties.push_back({.node = lump,
                        .to = MaterialPoint{nodes, Vec3::Constant(1.0 / 3.0)},
                        .stiffness = 1e4,
                        .rest_length = 0.1});
  auto simulation = simulation_of(scene, 1e-5, Vec3(0.0, 0.0, -10.0));
  for (int i = 0; i < 5000; ++i) simulation.step();
  EXPECT_GT(simulation.ties().pull(0), 1.0);

  simulation.break_facet(scene.elements.facets[1].nodes);
  simulation.step();
  EXPECT_FALSE(simulation.ties().is_broken(0));
  simulation.break_facet(nodes);
  const double stored = simulation.ties().elastic_energy();
  simulation.step();

  EXPECT_TRUE(simulation.ties().is_broken(0));
  EXPECT_NEAR(simulation.ties().dissipated(), stored, 0.02 * stored);
  EXPECT_LT(std::abs(simulation.energy().closure_error()), 1e-3);
}

/// A rope of bars from 0 to 2 m whose ends pay out, with three lumps on it that slide, one of them
/// with friction, one at a constant force, and one that comes off; 20 m/s² slantwise.
Scene loaded_rope() {
  Scene scene;
  const auto bar = dynamics::bar_section(0.004, 1e9);
  Cable cable;
  for (int i = 0; i <= 20; ++i) cable.nodes.push_back(scene.add_node(Vec3(0.1 * i, 0.0, 0.0)));
  for (std::size_t i = 0; i < 20; ++i)
    scene.add_beam(cable.nodes[i], cable.nodes[i + 1], bar, 8000.0);
  scene.cables.push_back(cable);
  for (const NodeId end : {cable.nodes.front(), cable.nodes.back()}) {
    scene.ties.push_back({.node = end,
                          .to = FixedPoint{scene.state.position[index_of(end)]},
                          .stiffness = 1e5,
                          .pushes = false,
                          .brake_force = 150.0,
                          .stroke = 0.05});
  }
  for (const std::size_t segment : {3U, 9U, 15U}) {
    const NodeId lump =
        add_lump(scene, Vec3(0.1 * static_cast<double>(segment) + 0.05, 0.0, -0.02));
    scene.ties.push_back({.node = lump,
                          .to = CablePlace{0, segment, 0.5},
                          .stiffness = 1e5,
                          .rest_length = 0.02,
                          .pushes = false});
  }
  scene.ties[2].friction = 0.3;
  scene.ties[3].slip_force = 5.0;
  scene.ties[4].strength = 60.0;
  return scene;
}

/// What is left is what a tie with friction gives up as it turns an inner corner at once, by the
/// square of the angle, and what the leapfrog is off by.
TEST(Ties, CloseTheLedgerOfARopeThatPaysOutAndSlides) {
  auto simulation = simulation_of(loaded_rope(), 1e-5, Vec3(8.0, 3.0, -18.0));

  EXPECT_LT(closure_until(simulation, 0.5), 1e-4);

  EXPECT_EQ(simulation.ties().slip(0), 0.05);
  EXPECT_EQ(simulation.ties().slip(1), 0.05);
  EXPECT_GT(simulation.ties().slip(2), 0.1);
  EXPECT_GT(simulation.ties().slip(3), 0.1);
  EXPECT_TRUE(simulation.ties().is_broken(4));
}

/// Where ties slide, are slack or on their brakes: the bound is never above the true limit.
TEST(Ties, AreInTheBoundOfTheStepWhereverTheySlide) {
  auto simulation = simulation_of(loaded_rope(), 1e-5, Vec3(8.0, 3.0, -18.0));
  for (int i = 0; i < 20; ++i) {
    step_until(simulation, 0.02 * (i + 1));
    const double exact = simulation.exact_critical_step().dt;
    EXPECT_LE(simulation.present_critical_step().dt, exact * (1.0 + 2e-3)) << i;
    EXPECT_GE(simulation.present_critical_step().dt, 0.5 * exact) << i;
  }
}

/// A tetrahedron that hangs by a corner and swings about it, spinning: the tie acts on a node that
/// follows.
TEST(Ties, TurnRigidBodiesByTheNodesThatFollowThem) {
  Scene scene;
  scene.materials.push_back({1e6, 0.3, 0.0});
  std::array<NodeId, 4> corners{};
  const std::array<Vec3, 4> places = {Vec3(0.0, 0.0, 0.0), Vec3(0.1, 0.0, -0.2),
                                      Vec3(-0.1, 0.1, -0.2), Vec3(0.0, -0.1, -0.2)};
  for (std::size_t i = 0; i < 4; ++i) corners[i] = scene.add_node(places[i], Held::everything);
  scene.add_facet(corners[1], corners[2], corners[3], 0.001, contact::MaterialId{0});
  const geometry::Mat3 inertia = Vec3(0.02, 0.03, 0.01).asDiagonal();
  scene.add_rigid_body(corners, {2.0, Vec3(0.0, 0.0, -0.15), inertia});
  const std::size_t body = index_of(scene.rigid_bodies[0].node);
  scene.state.angular_velocity[body] = Vec3(1.0, 2.0, 3.0);
  scene.ties.push_back({.node = corners[0], .to = FixedPoint{places[0]}, .stiffness = 1e4});
  auto simulation = simulation_of(scene, 1e-4, Vec3(0.0, 0.0, -10.0));

  double furthest = 0.0;
  double turnover = 0.0;
  double error = 0.0;
  while (simulation.time() < 2.0) {
    simulation.step();
    furthest = std::max(furthest, simulation.state().position[0].norm());
    turnover = std::max(turnover, simulation.energy().turnover());
    error = std::max(error, std::abs(simulation.energy().closure_error()));
  }

  // Weight and what goes round pull it out by some F / k, twice that as it is let go.
  EXPECT_GT(furthest, 20.0 / 1e4);
  EXPECT_LT(furthest, 3.0 * 40.0 / 1e4);
  EXPECT_LT(error, 1e-3 * turnover);
}

TEST(Ties, GoOnFromAStateToTheLastBitWithAnyThreads) {
  Scene scene = sliding_bead(0.2, 0.5);
  scene.ties.push_back({.node = NodeId{9}, .to = FixedPoint{Vec3::Zero()}, .stiffness = 1e4});
  scene.ties.back().pushes = false;
  scene.ties.back().brake_force = 1.0;
  scene.ties.back().stroke = 0.02;
  const Vec3 gravity(0.0, 0.0, -10.0);
  auto whole = simulation_of(scene, 5e-5, gravity);
  step_until(whole, 0.05);
  auto resumed = simulation_of(scene, 5e-5, gravity, 3);
  resumed.restore(whole.snapshot());

  for (auto* const simulation : {&whole, &resumed}) step_until(*simulation, 0.2);

  EXPECT_GT(whole.ties().slip(0), 0.01);
  EXPECT_EQ(whole.ties().slip(1), 0.02);
  EXPECT_EQ(resumed.snapshot().hash(), whole.snapshot().hash());
}

}  // namespace
}  // namespace plekton::test::ties_test
