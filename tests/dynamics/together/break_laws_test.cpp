// SPDX-License-Identifier: GPL-3.0-or-later
// Breaks under every contact law.
#include "contact/models.hpp"
#include "tests/support/breaking_net.hpp"
#include "tests/support/named_laws.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plekton::dynamics::break_laws_test {
namespace {

using contact::AnyLaw;
using test::kMesh;
using test::kWire;
using test::kWireRadius;

class BreakLaws : public testing::TestWithParam<test::NamedLaw> {
 protected:
  static contact::ContactModel model() {
    return contact::any_law({{{kWire, kWire}, GetParam().properties}});
  }
  static SimulationOptions options() {
    SimulationOptions options;
    options.time_step = 1e-5;
    options.motion.gravity = Vec3(0.0, 0.0, -9.81);
    return options;
  }

  /// A chain of held nodes along x, and a ball of 0.05 m.
  static Scene chain_and_ball(const Vec3& place) {
    Scene scene;
    scene.materials = {{1e6, 0.5, 0.6}};
    for (int i = 0; i <= 6; ++i) {
      scene.add_node(Vec3(kMesh * i, 0.0, 0.0), Held::everything);
      if (i == 0) continue;
      scene.add_beam(NodeId{i - 1}, NodeId{i}, circular_section(kWireRadius, 1e8, 0.3), 1000.0);
      scene.add_cylinder(NodeId{i - 1}, NodeId{i}, kWireRadius, kWire);
    }
    scene.add_sphere(place, 0.05, 200.0, kWire);
    return scene;
  }
};

TEST_P(BreakLaws, ABreakOutOfRangeChangesNoBit) {
  Scene scene = chain_and_ball(Vec3(0.25, 0.0, 0.0598));
  scene.state.velocity.back() = Vec3(0.5, 0.0, 0.0);
  Simulation whole(scene, options(), model());
  Simulation broken(scene, options(), model());
  for (int i = 0; i < 10000; ++i) {
    if (i == 100) broken.break_bond(1);
    whole.step();
    broken.step();
    ASSERT_EQ(whole.state().position.back(), broken.state().position.back()) << "in step " << i;
    ASSERT_EQ(whole.state().velocity.back(), broken.state().velocity.back()) << "in step " << i;
  }

  EXPECT_EQ(broken.surface().cell_count(), 5u);
}

TEST_P(BreakLaws, ASphereLeavesABrokenCylinderFreelyAndTheLedgerCloses) {
  // Pressed into the wire from below, or glued to it.
  Simulation simulation(chain_and_ball(Vec3(0.25, 0.0, -0.0598)), options(), model());
  for (int i = 0; i < 50; ++i) simulation.step();
  const double before = simulation.energy().closure_error();

  for (const std::size_t bond : {1U, 2U, 3U}) simulation.break_bond(bond);
  simulation.step();
  EXPECT_EQ(simulation.forces().force.back(), Vec3(0, 0, 0));
  EXPECT_EQ(simulation.energy().contact_elastic, 0.0);
  const double start = simulation.time();
  const double speed = simulation.state().velocity.back().z();
  while (simulation.time() < start + 0.05) simulation.step();

  EXPECT_NEAR(simulation.state().velocity.back().z(), speed - 9.81 * (simulation.time() - start),
              1e-12);
  EXPECT_LE(std::abs(simulation.energy().closure_error() - before),
            1e-2 * simulation.energy().turnover());
}

INSTANTIATE_TEST_SUITE_P(Of, BreakLaws, testing::ValuesIn(test::kLaws),
                         [](const auto& item) { return item.param.name; });

}  // namespace
}  // namespace plekton::dynamics::break_laws_test
