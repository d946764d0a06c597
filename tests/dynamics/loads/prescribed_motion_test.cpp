// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/prescribed_motion.hpp"

#include "dynamics/state/rotation_step.hpp"
#include "tests/support/beam_structure.hpp"
#include "tests/support/loaded_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace plekton::test::prescribed_motion_test {
namespace {

using dynamics::Held;
using dynamics::PrescribedMotion;
using dynamics::TimeTable;
using testing::HasSubstr;

constexpr double kEps = std::numeric_limits<double>::epsilon();

Scene lump_that(PrescribedMotion motion, const Vec3& place = Vec3(1.0, -2.0, 0.5)) {
  Scene scene;
  motion.nodes = {add_lump(scene, place)};
  scene.loads.motions.push_back(std::move(motion));
  return scene;
}

TEST(PrescribedMotion, IsAtThePlaceOfItsDisplacementTableAfterEveryStep) {
  PrescribedMotion motion;
  motion.displacement = Vec3(0.3, 0.0, -0.7);
  motion.factor = TimeTable({{0.1, 0.0}, {0.35, 1.0}, {0.5, -0.5}, {0.6, 2.0}});
  auto simulation = simulation_of(lump_that(motion), 0.0071, Vec3(0.0, 0.0, -9.81));

  while (simulation.time() < 1.0) {
    simulation.step();

    const Vec3 expected =
        Vec3(1.0, -2.0, 0.5) + motion.factor.at(simulation.time()) * motion.displacement;
    // x + dt ((target - x) / dt): a few roundings of numbers up to 3 m.
    EXPECT_LE((simulation.state().position[0] - expected).norm(), 8.0 * kEps * 3.0);
  }
  EXPECT_EQ(simulation.state().velocity[0], Vec3(Vec3::Zero()));  // at the end of the table
}

TEST(PrescribedMotion, CountsTheDisplacementFromThatOfTheStart) {
  PrescribedMotion motion;
  motion.displacement = Vec3(0.0, 0.1, 0.0);
  motion.factor = TimeTable({{0.0, 5.0}, {1.0, 6.0}});
  auto simulation = simulation_of(lump_that(motion), 0.25);

  simulation.step();

  EXPECT_NEAR(simulation.state().position[0].y(), -2.0 + 0.025, 8.0 * kEps * 2.0);
}

/// Of a load that began in another scene, a second ago, when the node was elsewhere.
TEST(PrescribedMotion, CountsFromWhereTheNodeWasAtTheStartOfItsFactor) {
  PrescribedMotion motion;
  motion.displacement = Vec3(0.0, 0.1, 0.0);
  motion.factor = TimeTable({{0.0, 5.0}, {4.0, 9.0}}).from(-1.0);
  motion.start = {Vec3(1.0, -2.1, 0.5)};
  auto simulation = simulation_of(lump_that(motion), 0.25);

  simulation.step();

  EXPECT_NEAR(simulation.state().position[0].y(), -2.1 + 0.125, 8.0 * kEps * 2.0);
}

TEST(PrescribedMotion, IsAtTheIntegralOfItsVelocityTable) {
  PrescribedMotion motion;
  motion.velocity = Vec3(2.0, 0.0, 1.0);
  motion.factor = TimeTable({{0.2, 0.0}, {0.4, 1.0}, {0.7, 1.0}, {0.8, -1.0}});
  auto simulation = simulation_of(lump_that(motion), 0.013);

  while (simulation.time() < 1.0) {
    simulation.step();

    const Vec3 expected =
        Vec3(1.0, -2.0, 0.5) + motion.factor.integral(simulation.time()) * motion.velocity;
    EXPECT_LE((simulation.state().position[0] - expected).norm(), 16.0 * kEps * 3.0);
  }
}

TEST(PrescribedMotion, TurnsByTheIntegralOfItsAngularVelocity) {
  PrescribedMotion motion;
  motion.held = Held::rotation;
  motion.angular_velocity = Vec3(0.0, 3.0, 0.0);
  motion.factor = TimeTable({{0.0, 0.0}, {0.5, 1.0}});
  auto simulation = simulation_of(lump_that(motion), 0.01);

  for (int i = 0; i < 100; ++i) simulation.step();

  const double angle = 3.0 * motion.factor.integral(simulation.time());
  const geometry::Quat expected(Eigen::AngleAxisd(angle, Vec3::UnitY()));
  // A turn by rounding in each of 100 steps.
  EXPECT_LE(simulation.state().orientation[0].angularDistance(expected), 100 * 8.0 * kEps);
  EXPECT_EQ(simulation.state().velocity[0], Vec3(Vec3::Zero()));
}

TEST(PrescribedMotion, LeavesOtherComponentsToTheForces) {
  PrescribedMotion motion;
  motion.held = Held::along_x | Held::about_z;
  motion.velocity = Vec3(1.0, 7.0, 7.0);
  motion.angular_velocity = Vec3(7.0, 7.0, 2.0);
  auto simulation = simulation_of(lump_that(motion), 0.125, Vec3(5.0, 0.0, -8.0));

  for (int i = 0; i < 8; ++i) simulation.step();

  const auto& state = simulation.state();
  EXPECT_NEAR(state.position[0].x(), 2.0, 8.0 * kEps * 2.0);
  EXPECT_EQ(state.position[0].y(), -2.0);
  EXPECT_EQ(state.position[0].z(), 0.5 - 0.5 * 8.0);  // a leapfrog falls exactly
  EXPECT_EQ(state.angular_velocity[0].head<2>(), Vec3::Zero().head<2>());
  EXPECT_NEAR(state.angular_velocity[0].z(), 2.0, 16.0 * kEps * 2.0);
}

TEST(PrescribedMotion, GoesRoundAnAxisExactlyOnItsCircle) {
  PrescribedMotion motion;
  motion.held = Held::everything;
  motion.turn = {Vec3(1.0, 0.0, 0.0), Vec3(1.0, 2.0, 2.0) / 3.0, 5.0};
  motion.displacement = Vec3(0.0, 0.0, 0.2);
  motion.factor = TimeTable({{0.0, 0.5}, {0.4, 1.5}, {0.6, -1.0}});
  const Vec3 start(1.0, -2.0, 0.5);
  auto simulation = simulation_of(lump_that(motion, start), 0.0071);

  for (int i = 0; i < 100; ++i) {
    simulation.step();

    const double share = motion.factor.at(simulation.time()) - 0.5;
    const Eigen::AngleAxisd turn(5.0 * share, motion.turn->axis);
    const Vec3 expected =
        motion.turn->point + turn * (start - motion.turn->point) + share * motion.displacement;
    EXPECT_LE((simulation.state().position[0] - expected).norm(), 16.0 * kEps * 5.0);
    EXPECT_LE(simulation.state().orientation[0].angularDistance(geometry::Quat(turn)),
              (i + 1) * 8.0 * kEps * 10.0);
  }
}

// A beam from the axis outward, turned about it with all of its nodes free but the first: the
// moment that turns it is that which its inertia takes.
TEST(PrescribedMotion, ThatTurnsABeamGivesItsAngularMomentumAndItsEnergy) {
  Scene scene = chain(4, 0.2, dynamics::circular_section(0.01, 1e8, 0.3));
  PrescribedMotion motion;
  motion.nodes = {NodeId{0}};
  motion.held = Held::everything;
  motion.turn = {Vec3(-0.1, 0.0, 0.0), Vec3::UnitZ(), 0.2};
  motion.factor = TimeTable({{0.0, 0.0}, {0.05, 1.0}});
  scene.loads.motions.push_back(motion);
  auto simulation = simulation_of(scene, 0.0);
  double moment = 0.0;  // N m s, about the axis, of the support on the beam
  double momentum = 0.0;
  double closure = 0.0;

  while (simulation.time() < 0.06) {
    simulation.step();
    const auto reaction = simulation.support_reaction(std::vector{NodeId{0}}, motion.turn->point);
    moment += simulation.time_step() * reaction.moment.z();
    closure = std::max(closure, std::abs(simulation.energy().closure_error()));
  }
  for (std::size_t i = 1; i < scene.state.size(); ++i) {
    momentum +=
        simulation.properties().inertia[i] * simulation.state().angular_velocity[i].z() +
        simulation.properties().mass[i] * (simulation.state().position[i] - motion.turn->point)
                                              .cross(simulation.state().velocity[i])
                                              .z();
  }

  EXPECT_GT(momentum, 1e-4);
  // The place at which forces act lies half a step before that of the momentum.
  EXPECT_NEAR(std::abs(moment), std::abs(momentum), 1e-2 * std::abs(momentum));
  EXPECT_LT(closure, 1e-2 * simulation.energy().turnover());
}

// The tips of a blade went on unforeseen: of a body that turned about its centre nothing was known.
TEST(PrescribedMotion, KnowsHowFastWhatTurnsWithItsNodesGoes) {
  PrescribedMotion motion;
  motion.nodes = {NodeId{0}};
  motion.turn = dynamics::AxisTurn{Vec3::Zero(), Vec3::UnitZ(), 2.0};
  motion.factor = TimeTable({{0.0, 0.0}, {0.5, 1.0}});
  Scene scene;
  for (const double x : {0.0, 0.2, -0.1}) add_lump(scene, Vec3(x, 0.0, 0.0));
  scene.rigid_bodies = {{NodeId{0}, {NodeId{1}, NodeId{2}}}};
  const double reach =
      dynamics::reach_around(motion.nodes, scene.rigid_bodies, scene.state.position);
  EXPECT_EQ(reach, 0.2);
  EXPECT_EQ(
      dynamics::reach_around(std::vector{NodeId{1}}, scene.rigid_bodies, scene.state.position),
      0.0);

  const dynamics::TimeSpan all{0.0, 1.0};
  EXPECT_DOUBLE_EQ(dynamics::MovedNodes(motion, scene.state, reach).largest_speed(all),
                   2.0 / 0.5 * 0.2);
  motion.turn.reset();
  motion.angular_velocity = Vec3(0.0, 3.0, 4.0);
  EXPECT_DOUBLE_EQ(dynamics::MovedNodes(motion, scene.state, reach).largest_speed(all), 5.0 * 0.2);
}

TEST(PrescribedMotion, ThatTurnsIsRefusedWithoutAnAxisOrWithFreeComponents) {
  PrescribedMotion motion;
  motion.held = Held::along_x;
  motion.turn = {Vec3::Zero(), Vec3(0.0, 0.0, 2.0), 1.0};

  const std::string problems = problems_of(lump_that(motion));

  EXPECT_THAT(problems,
              HasSubstr("prescribed motion 0: the axis of its turn is not a unit vector"));
  EXPECT_THAT(problems, HasSubstr("a turn about an axis moves nodes along all axes"));
}

/// A beam whose end is moved to and fro and turned, so that its velocity changes in every step.
Scene shaken_beam(bool held_along_the_beam_only) {
  Scene scene = chain(8, 0.2, dynamics::circular_section(0.003, 1e7, 0.3));
  scene.properties.held.back() = Held::everything;
  PrescribedMotion motion;
  motion.nodes = {NodeId{0}};
  motion.held = held_along_the_beam_only ? Held::along_x : Held::everything;
  motion.velocity = Vec3(0.5, 0.2, 0.3);
  motion.angular_velocity = Vec3(2.0, 1.0, 0.0);
  motion.factor = TimeTable({{0.0, 0.0}, {0.004, 1.0}, {0.012, -1.0}, {0.02, 0.5}});
  scene.loads.motions.push_back(motion);
  return scene;
}

TEST(PrescribedMotion, IsCountedInTheEnergyToSecondOrder) {
  for (const bool along_the_beam_only : {false, true}) {
    const Scene scene = shaken_beam(along_the_beam_only);
    const double dt = LoadedSimulation(scene, {}).time_step();
    auto coarse = simulation_of(scene, dt);
    auto fine = simulation_of(scene, 0.25 * dt);

    const double error = closure_until(coarse, 0.03);

    EXPECT_GT(coarse.energy().external_work, 1e-6);
    EXPECT_LT(error, 1e-3);
    // The margin is for terms of higher order. Along the beam alone all is linear and exact.
    EXPECT_LT(closure_until(fine, 0.03), std::max(1.2 * error / 16.0, 1e-12));
  }
}

TEST(PrescribedMotion, MayHoldANodeWithoutMass) {
  Scene scene;
  PrescribedMotion motion;
  motion.nodes = {scene.add_node(Vec3::Zero())};
  motion.held = Held::everything;
  motion.velocity = Vec3::UnitX();
  scene.loads.motions.push_back(motion);

  auto simulation = simulation_of(scene, 0.5);
  simulation.step();

  EXPECT_EQ(simulation.state().position[0], Vec3(0.5, 0.0, 0.0));
}

TEST(PrescribedMotion, IsRefusedWhereAComponentIsPrescribedTwice) {
  Scene scene;
  const NodeId a = add_lump(scene, Vec3::Zero());
  const NodeId b = add_lump(scene, Vec3::UnitX());
  PrescribedMotion up, along;
  up.nodes = {a, b};
  up.held = Held::along_z;
  along.nodes = {b};
  along.held = Held::along_x | Held::along_y;
  scene.loads.motions = {up, along};
  EXPECT_EQ(problems_of(scene), "");

  scene.loads.motions[1].held = Held::translation;
  EXPECT_THAT(problems_of(scene),
              HasSubstr("prescribed motion 1: node 1: its translation along z is held or "
                        "prescribed already"));

  scene.loads.motions.pop_back();
  scene.properties.held[0] = Held::translation;
  EXPECT_THAT(problems_of(scene),
              HasSubstr("prescribed motion 0: node 0: its translation along z"));
}

TEST(PrescribedMotion, IsRefusedForNodesThatAreNotThereOrNamedTwice) {
  Scene scene;
  add_lump(scene, Vec3::Zero());
  PrescribedMotion motion;
  motion.nodes = {NodeId{0}, NodeId{3}, NodeId{0}};
  motion.held = Held::nothing;
  motion.velocity.x() = std::numeric_limits<double>::infinity();
  scene.loads.motions = {motion, PrescribedMotion{}};

  const std::string problems = problems_of(scene);

  EXPECT_THAT(problems, HasSubstr("prescribed motion 0: there is no node 3, only 1 nodes"));
  EXPECT_THAT(problems, HasSubstr("prescribed motion 0: names node 0 twice"));
  EXPECT_THAT(problems, HasSubstr("prescribed motion 0: prescribes no component"));
  EXPECT_THAT(problems, HasSubstr("its velocity (inf   0   0) is not finite"));
  EXPECT_THAT(problems, HasSubstr("prescribed motion 1: has no nodes"));
}

}  // namespace
}  // namespace plekton::test::prescribed_motion_test
