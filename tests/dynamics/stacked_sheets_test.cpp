// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/membrane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// A sheet that falls by 1 mm onto an equal one that is held: all their edges coincide.
namespace plekton::test {
namespace {

using dynamics::Held;
using dynamics::Simulation;

constexpr double kThickness = 0.01;  // m

void add_sheet(dynamics::Scene& scene, double height, Held held) {
  const auto mesh = geometry::plane_sheet({0.4, 0.4, 4, 4});
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
  double lowest;   ///< m, of a node of the upper sheet at any step
};

/// @param part  of half of the critical step with all contacts that may come
Fall fall(double part) {
  dynamics::SimulationOptions options;
  options.motion.gravity = {0.0, 0.0, -9.81};
  options.time_step =
      part * dynamics::kSafety * Simulation(stacked_sheets(), options).critical_step().dt;
  Simulation simulation(stacked_sheets(), options);
  const std::size_t nodes = simulation.state().position.size();
  double error = 0.0, turnover = 0.0;
  Fall found{0.0, 1.0};
  while (simulation.time() < 0.1) {
    simulation.step();
    const dynamics::Energy energy = simulation.energy();
    error = std::max(error, std::abs(energy.closure_error()));
    turnover = std::max(turnover, energy.turnover());
    for (std::size_t i = nodes / 2; i < nodes; ++i) {
      found.lowest = std::min(found.lowest, simulation.state().position[i].z());
    }
  }
  found.closure = error / turnover;
  return found;
}

// It stays above the lower sheet, and what its energy is off by falls faster than with the first
// order of the step, as that of contacts that touch and leave at moments within a step does.
TEST(StackedSheets, BounceWithoutEnergyFromNothing) {
  const Fall coarse = fall(1.0);
  const Fall fine = fall(0.25);
  EXPECT_GT(coarse.lowest, 0.9 * kThickness);
  EXPECT_LT(coarse.closure, 0.05);
  EXPECT_LT(fine.closure, 0.25 * coarse.closure);
}

}  // namespace
}  // namespace plekton::test
