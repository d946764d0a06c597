// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/free_bodies.hpp"
#include "tests/support/free_collision.hpp"

#include <gtest/gtest.h>

/// Two free structures that collide: no gravity, nothing held.
namespace plekton::dynamics::structure_collision_test {
namespace {

using test::momenta_of;

using namespace test::free_bodies;

struct Case {
  const char* name;
  Body (*still)();
  Body (*flying)();
  Vec3 turns;
  double friction;
};

class StructureCollision : public testing::TestWithParam<Case> {};

Scene scene_of(const Case& item) {
  Scene scene;
  scene.materials = {{1e7, 0.3, item.friction}};
  add(scene, item.still(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero());
  // Its lowest node, if it has one, just above the middle.
  Scene alone;
  add(alone, item.flying(), item.turns, Vec3::Zero(), Vec3::Zero());
  Vec3 lowest = Vec3::Zero();
  for (const Vec3& x : alone.state.position) {
    if (x.z() < lowest.z() - 1e-3) lowest = x;
  }
  const Vec3 middle(0.03, 0.02, 2.0 * kRadius + 1e-3);
  add(scene, item.flying(), item.turns, middle - lowest, Vec3(0.3, 0.1, -1.0));
  return scene;
}

TEST_P(StructureCollision, KeepsBothMomentaAndGainsNoEnergy) {
  // A tenth of the chosen step: the ledger's error falls with its square.
  const Simulation probe(scene_of(GetParam()), {.motion = {.gravity = Vec3::Zero()}});
  Simulation simulation(scene_of(GetParam()), {.time_step = 0.1 * probe.time_step(),
                                               .motion = {.gravity = Vec3::Zero()}});
  const auto before = momenta_of(simulation);
  const double energy = simulation.energy().initial;

  std::size_t touched = 0;
  double worst_linear = 0.0, worst_angular = 0.0, most = 0.0, worst_closure = 0.0;
  while (simulation.time() < 0.05) {
    simulation.step();
    const auto now = momenta_of(simulation);
    worst_linear = std::max(worst_linear, (now.linear - before.linear).norm());
    worst_angular = std::max(worst_angular, (now.angular - before.angular).norm());
    const Energy e = simulation.energy();
    most = std::max(most, e.kinetic + e.contact_elastic + e.bond_elastic);
    worst_closure = std::max(worst_closure, e.closure());
    touched += simulation.contacts().counts().between_structures > 0;
  }

  EXPECT_GT(touched, 0u);
  EXPECT_LE(worst_linear, 1e-10 * before.linear.norm());
  EXPECT_LE(worst_angular, 1e-10 * before.angular.norm());
  EXPECT_LE(most, (1.0 + 1e-3) * energy);
  EXPECT_LE(worst_closure, 5e-3);
  EXPECT_LT(simulation.largest_overlap_ratio(), 0.5);
}

INSTANTIATE_TEST_SUITE_P(
    Of, StructureCollision,
    testing::Values(Case{"CrossedChains", chain, chain, Vec3(0, 0, 1.2), 0.0},
                    Case{"CrossedChainsWithFriction", chain, chain, Vec3(0, 0.1, 1.2), 0.7},
                    Case{"ParallelChains", chain, chain, Vec3(0, 0, 0), 0.7},
                    Case{"ChainOnSheet", sheet, chain, Vec3(0, 0.05, 0.4), 0.7},
                    Case{"SheetOnSheet", sheet, sheet, Vec3(0, 0, 0.3), 0.0},
                    Case{"SheetOnSheetWithFriction", sheet, sheet, Vec3(0.05, 0, 0.3), 0.7},
                    Case{"SheetEdgeOnSheet", sheet, sheet, Vec3(1.2, 0.1, 0.3), 0.7}),
    [](const auto& item) { return item.param.name; });

}  // namespace
}  // namespace plekton::dynamics::structure_collision_test
