// SPDX-License-Identifier: GPL-3.0-or-later
// Structures of which the last pair of cells that touches goes with a break.
#include "tests/support/breaking_net.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace plekton::dynamics::break_last_pair_test {
namespace {

using test::BreakingSimulation;
using test::kWire;
using test::kWireRadius;
using test::Random;

/// m, between the cores of bodies that overlap by a hundredth of their radius.
constexpr double kDeep = 1.99 * kWireRadius;

void add_bar(Scene& scene, const Vec3& x0, const Vec3& x1) {
  const NodeId a = scene.add_node(x0, Held::rotation);
  const NodeId b = scene.add_node(x1, Held::rotation);
  scene.add_beam(a, b, bar_section(kWireRadius, 1e8), 1000.0);
  scene.add_cylinder(a, b, kWireRadius, kWire);
}

SimulationOptions without_gravity(double time_step) {
  SimulationOptions options;
  options.time_step = time_step;
  options.motion.gravity = Vec3::Zero();
  return options;
}

/// Two bars, each along an axis and one above the other, and nothing else.
Scene crossing_bars() {
  Scene scene;
  scene.materials = {{1e6, 0.5, 0.6}};
  add_bar(scene, Vec3(-0.1, 0.0, kDeep), Vec3(0.1, 0.0, kDeep));
  add_bar(scene, Vec3(0.0, -0.1, 0.0), Vec3(0.0, 0.1, 0.0));
  return scene;
}

TEST(BreakLastPair, LeavesNothingThatPushesWhereNoOtherCellsAreNear) {
  BreakingSimulation simulation(crossing_bars(), without_gravity(1e-6));
  simulation.step();
  ASSERT_EQ(simulation.contacts().counts().between_structures, 1u);

  simulation.break_bond(0);
  for (int i = 0; i < 3; ++i) simulation.step();

  EXPECT_EQ(simulation.contacts().counts().between_structures, 0u);
  EXPECT_EQ(simulation.contacts().elastic_energy(), 0.0);
  for (const Vec3& force : simulation.forces().force) EXPECT_EQ(force, Vec3(Vec3::Zero()));
}

TEST(BreakLastPair, AccountsForTheFrictionSpringThatGoesWithIt) {
  // One bar is moved along the other, which it does not slide on yet: force and way of the spring
  // of their friction grow together. Then it is gone.
  Scene scene = crossing_bars();
  for (const std::size_t node : {0U, 1U}) scene.state.velocity[node] = Vec3(0.0, 0.05, 0.0);
  BreakingSimulation simulation(scene, without_gravity(1e-6));
  for (int i = 0; i < 400; ++i) simulation.step();
  const auto& x = simulation.state().position;
  const double way = 0.5 * (x[0].y() + x[1].y() - x[2].y() - x[3].y());
  const auto& force = simulation.forces().force;
  const double spring = -0.5 * (force[0].y() + force[1].y()) * way;
  ASSERT_GT(spring, 0.0);

  simulation.break_bond(0);
  for (int i = 0; i < 3; ++i) simulation.step();

  // What the spring does in the last of 400 steps is twice 1/400 of what it stores.
  EXPECT_EQ(simulation.energy().contact_elastic, 0.0);
  EXPECT_LT(std::abs(simulation.energy().closure_error()), 0.01 * spring);
}

/// Some bars and facets at random about the origin, of which many cross; each a body of its own.
Scene random_bodies(Random& random) {
  Scene scene;
  scene.materials = {{1e6, 0.5, 0.6}};
  const std::size_t count = 2 + random.index(3);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 middle(0.0, 0.0, 1.9 * kWireRadius * static_cast<double>(i));
    const double turn = random.uniform(0.0, 6.28);
    const Vec3 half(0.1 * std::cos(turn), 0.1 * std::sin(turn), 0.0);
    if (random.index(2) == 0) {
      add_bar(scene, middle - half, middle + half);
      continue;
    }
    const Vec3 side = Vec3::UnitZ().cross(half);
    const NodeId a = scene.add_node(middle - half - side, Held::rotation);
    const NodeId b = scene.add_node(middle + half - side, Held::rotation);
    const NodeId c = scene.add_node(middle + side, Held::rotation);
    for (const auto& [p, q] : {std::pair{a, b}, {b, c}, {c, a}})
      scene.add_beam(p, q, bar_section(kWireRadius, 1e8), 1000.0);
    scene.add_facet(a, b, c, kWireRadius, kWire);
  }
  return scene;
}

TEST(BreakLastPair, NeverDisturbsWhatIsLeftOfRandomBodiesThatCross) {
  // Every bond breaks, one after the other in any order, with none to some steps in between: at the
  // end nothing touches anything, and all momentum is that of before.
  Random random(15);
  for (int trial = 0; trial < 300; ++trial) {
    const Scene scene = random_bodies(random);
    BreakingSimulation simulation(scene, without_gravity(2e-6));
    std::vector<std::size_t> order(scene.bonds.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.index(i)]);
    for (const std::size_t bond : order) {
      for (std::size_t k = random.index(4); k > 0; --k) simulation.step();
      simulation.break_bond(bond);
    }
    for (int i = 0; i < 3; ++i) simulation.step();

    EXPECT_EQ(simulation.contacts().counts().between_structures, 0u) << "trial " << trial;
    Vec3 momentum = Vec3::Zero();
    double size = 0.0;
    for (std::size_t n = 0; n < scene.state.size(); ++n) {
      const Vec3 one = simulation.properties().mass[n] * simulation.state().velocity[n];
      momentum += one;
      size += one.norm();
    }
    EXPECT_LE(momentum.norm(), 1e-12 * size) << "trial " << trial;
  }
}

}  // namespace
}  // namespace plekton::dynamics::break_last_pair_test
