// SPDX-License-Identifier: GPL-3.0-or-later
// D8 and D9 of YADE at junctions of which a branch has broken off: there several branches own the
// contact at once, histories are lost, and forces jump.
#include "tests/support/breaking_net.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace plekton::dynamics::break_junction_test {
namespace {

using test::BreakingSimulation;
using test::kWire;
using test::kWireRadius;

/// Bonds with cylinders from a node at the origin, held: along -x and x, then to the sides.
Scene junction(int branches) {
  Scene scene;
  scene.materials = {{1e6, 0.5, 0.6}};
  scene.add_node(Vec3::Zero(), Held::everything);
  const std::array<Vec3, 4> ends{Vec3(-0.3, 0, 0), Vec3(0.3, 0, 0), Vec3(0, 0.3, 0),
                                 Vec3(0, -0.3, 0)};
  for (const Vec3& end : ends) scene.add_node(end, Held::everything);
  for (int i = 1; i <= branches; ++i) {
    scene.add_beam(NodeId{0}, NodeId{i}, circular_section(kWireRadius, 1e8, 0.3), 1000.0);
    scene.add_cylinder(NodeId{0}, NodeId{i}, kWireRadius, kWire);
  }
  return scene;
}

void slide_along_x(Scene& scene, const Vec3& place) {
  scene.add_node(place, Held::everything);
  scene.state.velocity.back() = Vec3(0.1, 0.0, 0.0);
}

void add_held_ball(Scene& scene, const Vec3& place) {
  scene.add_sphere(place, 0.05, 1000.0, kWire);
  scene.properties.held.back() = Held::everything;
  scene.state.velocity.back() = Vec3(0.1, 0.0, 0.0);
}

struct Crossing {
  double largest = 0.0;   ///< N, normal force on the last node
  double smallest = 1e9;  ///< N
  double jump = 0.0;      ///< N, of the whole force in one step
};

/// Takes the last node from x = -0.03 to 0.03 m over a junction of four branches, two of which
/// broke before, and over one that never had them: the same bits.
Crossing cross(Scene (*scene_of)(int branches), double time_step) {
  const SimulationOptions options{.time_step = time_step, .motion = {.gravity = Vec3::Zero()}};
  BreakingSimulation broken(scene_of(4), options);
  BreakingSimulation never(scene_of(2), options);
  broken.break_bond(2);
  broken.break_bond(3);
  Crossing crossing;
  Vec3 last = Vec3::Zero();
  while (broken.time() < 0.6) {
    broken.step();
    never.step();
    const Vec3& force = broken.forces().force.back();
    EXPECT_EQ(force, never.forces().force.back());
    if (testing::Test::HasFailure()) break;
    crossing.largest = std::max(crossing.largest, force.z());
    crossing.smallest = std::min(crossing.smallest, force.z());
    if (broken.steps() > 1) crossing.jump = std::max(crossing.jump, (force - last).norm());
    last = force;
  }
  return crossing;
}

Scene ball_on(int branches) {
  Scene scene = junction(branches);
  add_held_ball(scene, Vec3(-0.03, 0.0, 0.0595));
  return scene;
}

Scene wire_on(int branches) {
  Scene scene = junction(branches);
  slide_along_x(scene, Vec3(-0.03, 0.2, 0.0195));
  slide_along_x(scene, Vec3(-0.03, -0.2, 0.0195));
  const auto first = static_cast<int>(scene.state.size()) - 2;
  scene.add_cylinder(NodeId{first}, NodeId{first + 1}, kWireRadius, kWire);
  return scene;
}

TEST(BreakJunction, D8ASphereIsHeldByOneContactAndDraggedByOneSpringAcrossIt) {
  const Crossing crossing = cross(ball_on, 1e-4);
  const Crossing finer = cross(ball_on, 1e-5);

  EXPECT_NEAR(crossing.largest, crossing.smallest, 1e-9 * crossing.largest);
  EXPECT_LE(finer.jump, 0.11 * crossing.jump);  // in proportion to the step
}

TEST(BreakJunction, D9AWireIsHeldByOneContactAndDraggedByOneSpringAcrossIt) {
  const Crossing crossing = cross(wire_on, 1e-4);
  const Crossing finer = cross(wire_on, 1e-5);

  EXPECT_NEAR(crossing.largest, crossing.smallest, 1e-9 * crossing.largest);
  EXPECT_LE(finer.jump, 0.11 * crossing.jump);
}

}  // namespace
}  // namespace plekton::dynamics::break_junction_test
