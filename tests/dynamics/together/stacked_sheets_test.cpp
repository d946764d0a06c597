// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/membrane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// A sheet that falls by 1 mm onto an equal one that is held: all their edges coincide.
namespace plekton::test::stacked_sheets_test {
namespace {

using dynamics::Held;
using dynamics::Simulation;

constexpr double kSide = 0.4;        // m
constexpr double kThickness = 0.01;  // m

void add_sheet(dynamics::Scene& scene, double height, Held held) {
  const auto mesh = geometry::plane_sheet({kSide, kSide, 4, 4});
  const auto sheet = geometry::make_membrane(mesh, {.thickness = kThickness});
  const auto fibre = dynamics::circular_section(0.5 * kThickness, 1e7, 0.3);
  std::vector<geometry::NodeId> ids;
  for (const geometry::Vec3& x : sheet.nodes)
    ids.push_back(scene.add_node(x + geometry::Vec3(0.0, 0.0, height), held));
  const auto id = [&](geometry::NodeId node) { return ids[index_of(node)]; };
  for (const auto& [n, r] : sheet.facets)
    scene.add_facet(id(n[0]), id(n[1]), id(n[2]), r, contact::MaterialId{0});
  for (const auto& [a, b] : sheet.edges) scene.add_beam(id(a), id(b), fibre, 1000.0);
}

dynamics::Scene stacked_sheets() {
  dynamics::Scene scene;
  scene.materials = {{.young_modulus = 2e6, .stiffness_ratio = 0.5, .friction = 0.5}};
  add_sheet(scene, 0.0, Held::everything);
  add_sheet(scene, kThickness + 1e-3, Held::nothing);
  return scene;
}

struct Fall {
  double closure;  ///< of the ledger, at any step
  double limit;    ///< of it, as derived below
  double lowest;   ///< m, of a node of the upper sheet at any step
};

/// Largest closure of a collision in steps of length dt, (omega dt)² / 4.
///
/// All of the upper sheet touches at once, at a speed v and, within a step, at an overlap u v dt
/// with 0 < u < 1. With the spring K of all contacts and the mass M the leapfrog then has an energy
/// of 1/2 M v² (1 - (omega dt)² u (1 - u)), omega² = K / M; where the sheets part it has as much more
/// at most. A contact has E R (N/m) and an area of (2 R)².
double largest_closure(const dynamics::Scene& scene, double dt) {
  const double stiffness = scene.materials[0].young_modulus * kSide * kSide / (2.0 * kThickness);
  double mass = 0.0;
  for (std::size_t i = scene.state.size() / 2; i < scene.state.size(); ++i)
    mass += scene.properties.mass[i];
  return 0.25 * stiffness / mass * dt * dt;
}

/// Down, and up again until it is above the lower one for good; it comes back at 44 ms.
/// @param part  of half of the critical step with all contacts that may come
Fall fall(double part) {
  dynamics::SimulationOptions options;
  options.motion.gravity = {0.0, 0.0, -9.81};
  options.time_step =
      part * dynamics::kSafety * Simulation(stacked_sheets(), options).critical_step().dt;
  Simulation simulation(stacked_sheets(), options);
  const std::size_t nodes = simulation.state().position.size();
  double error = 0.0, turnover = 0.0;
  bool has_touched = false;
  Fall found{0.0, largest_closure(stacked_sheets(), options.time_step), 1.0};
  while (simulation.time() < 0.025) {
    simulation.step();
    const dynamics::Energy energy = simulation.energy();
    error = std::max(error, std::abs(energy.closure_error()));
    turnover = std::max(turnover, energy.turnover());
    has_touched = has_touched || energy.contact_elastic > 0.0;
    for (std::size_t i = nodes / 2; i < nodes; ++i) {
      found.lowest = std::min(found.lowest, simulation.state().position[i].z());
    }
  }
  EXPECT_TRUE(has_touched);
  EXPECT_EQ(simulation.energy().contact_elastic, 0.0);
  found.closure = error / turnover;
  return found;
}

// It stays above the lower sheet. The scene of 1 m is in tests/apps/run/together/defects_test.cpp.
TEST(StackedSheets, BounceWithinTheErrorOfATouch) {
  for (const double part : {1.0, 0.5, 0.25}) {
    const Fall found = fall(part);
    EXPECT_GT(found.lowest, 0.9 * kThickness) << part;
    EXPECT_LT(found.closure, found.limit) << part;
  }
}

}  // namespace
}  // namespace plekton::test::stacked_sheets_test
