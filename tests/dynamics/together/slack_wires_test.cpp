// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"
#include "tests/support/beam_structure.hpp"
#include "tests/support/loaded_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

/// Wires that become taut and slack: their force begins and ends within a step. What is lost and made
/// by that is of either sign; in 180 times it adds up to less than what a chosen step promises, 1/16
/// of what went through.
namespace plekton::test::slack_wires_test {
namespace {

using dynamics::Held;

constexpr double kLength = 0.1;         // m
constexpr double kPromised = 1.0 / 16;  // apps/scenario.md
const dynamics::WireCurve kCurve{{{0.01, 10.0}, {0.05, 15.0}, {0.2, 6.0}}};

/// Bars in a line, held at the first node, and thrown along it at the last one.
/// @param slack  m, by which the first is shorter than at rest
Scene thrown(int bars, double speed, double slack) {
  Scene scene = chain(bars, kLength, dynamics::wire_section(0.001, kCurve));
  scene.properties.held.assign(scene.state.size(), Held::rotation);
  scene.properties.held[0] = Held::everything;
  std::vector<std::size_t> wires(scene.bonds.size());
  for (std::size_t i = 0; i < wires.size(); ++i) wires[i] = i;
  scene.bond_laws = {{kCurve, wires}};
  for (std::size_t i = 1; i < scene.state.size(); ++i) scene.state.position[i].x() -= slack;
  scene.state.velocity.back() = {speed, 0.0, 0.0};
  return scene;
}

/// In ten phases of the step. @returns the largest closure
double largest_closure(int bars, double speed) {
  double largest = 0.0;
  for (int phase = 0; phase < 10; ++phase) {
    LoadedSimulation simulation = simulation_of(thrown(bars, speed, 1e-5 * phase * speed), 0.0);
    largest = std::max(largest, closure_until(simulation, 0.05));
  }
  return largest;
}

TEST(SlackWires, AChosenStepFollowsThemAsTheyBecomeTautAndSlack) {
  for (const int bars : {1, 2, 6}) {
    for (const double speed : {0.3, 1.0, 3.0})
      EXPECT_LT(largest_closure(bars, speed), kPromised) << bars << " bars, " << speed << " m/s";
  }
}

/// Wires at rest between nodes that a tie draws together: they become slack in the first step, with
/// speeds that nothing has at the start. A step that had to be shortened to follow them after that
/// would make energy while the tie still pulls.
TEST(SlackWires, TheFirstStepIsChosenForTheSpeedsThatForcesBring) {
  Scene scene = thrown(4, 0.0, 0.0);
  scene.properties.held.assign(scene.state.size(), Held::rotation);
  dynamics::Tie tie;
  tie.node = geometry::NodeId{4};
  tie.to = dynamics::material_point(geometry::NodeId{0});
  tie.stiffness = 4e4;
  scene.ties.push_back(tie);
  LoadedSimulation simulation = simulation_of(std::move(scene), 0.0);
  const double first = simulation.time_step();

  EXPECT_LT(closure_until(simulation, 8.0 * first), 0.01);
  EXPECT_GT(simulation.time_step(), 0.5 * first);
}

/// A wire that is pulled and swings about that without becoming slack is followed exactly.
TEST(SlackWires, LeaveTheStepOfTautWiresAsItIs) {
  Scene pulled = thrown(1, 0.0, -0.0005);
  pulled.state.velocity[1] = {0.1, 0.0, 0.0};
  Scene still = pulled;
  still.state.velocity[1] = Vec3::Zero();

  EXPECT_EQ(simulation_of(std::move(pulled), 0.0).time_step(),
            simulation_of(std::move(still), 0.0).time_step());
}

}  // namespace
}  // namespace plekton::test::slack_wires_test
