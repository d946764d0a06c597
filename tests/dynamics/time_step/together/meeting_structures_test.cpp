// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"
#include "tests/support/beam_structure.hpp"
#include "tests/support/loaded_scene.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace plekton::test::meeting_structures_test {
namespace {

constexpr double kThin = 0.001;  // m, radius of the bars
constexpr double kSpeed = 50.0;  // m/s

/// A soft bar that flies at another one across it, beside a large grain.
/// @param height  m, between the surfaces
Scene crossing_bars(double height) {
  Scene scene;
  scene.materials = {{1e4, 0.3, 0.3}};
  const auto section = dynamics::circular_section(kThin, 1e4, 0.3);
  for (const auto& [along, z] :
       {std::pair{Vec3(0.1, 0, 0), 0.0}, {Vec3(0, 0.1, 0), 2.0 * kThin + height}}) {
    const NodeId first = scene.add_node(Vec3(0, 0, z) - along);
    const NodeId second = scene.add_node(Vec3(0, 0, z) + along);
    scene.add_beam(first, second, section, 1000.0);
    scene.add_cylinder(first, second, kThin, contact::MaterialId{0});
  }
  for (const std::size_t node : {2U, 3U}) scene.state.velocity[node] = Vec3(0, 0, -kSpeed);
  scene.add_sphere(Vec3(0, 0, -10.0), 0.1, 1000.0, contact::MaterialId{0});
  return scene;
}

double step_over(double height) {
  return simulation_of(crossing_bars(height), 0.0).time_step();
}

TEST(StructuresThatMeet, MoveByATenthOfTheirOwnRadiusInAChosenStep) {
  EXPECT_LE(step_over(0.001) * kSpeed, 0.1 * kThin * (1.0 + 1e-12));
  // Of the grain's 0.1 m it would be a hundred times as long.
  EXPECT_GT(step_over(2.0) * kSpeed, 0.3 * kThin);
}

}  // namespace
}  // namespace plekton::test::meeting_structures_test
