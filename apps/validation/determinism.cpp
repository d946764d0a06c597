// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/validation_case.hpp"
#include "dynamics/simulation.hpp"
#include "dynamics/state_hash.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/membrane.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace plekton::apps::determinism {
namespace {

using dynamics::Held;
using geometry::Vec3;

/// Layers of grains above a sheet that is held at its rim.
dynamics::Scene grains_over_a_sheet() {
  constexpr double kWidth = 0.2;     // m
  constexpr double kRadius = 0.004;  // m, of the largest grain
  constexpr contact::MaterialId kFabric{0};
  dynamics::Scene scene;
  scene.materials = {{2e7, 0.3, 0.5}};
  const auto mesh =
      geometry::plane_sheet({.width = kWidth, .length = kWidth, .cells_x = 16, .cells_y = 16});
  const auto sheet = geometry::make_membrane(mesh, {.thickness = 0.002});
  for (const Vec3& x : sheet.nodes)
    scene.add_node(x, x.cwiseAbs().maxCoeff() > 0.499 * kWidth ? Held::everything : Held::nothing);
  for (const auto& [n, r] : sheet.facets) scene.add_facet(n[0], n[1], n[2], r, kFabric);
  const auto fibre = dynamics::circular_section(0.001, 5e7, 0.3);
  for (const auto& [a, b] : sheet.edges) scene.add_beam(a, b, fibre, 400.0);
  constexpr int kRow = 16;
  for (int layer = 0; layer < 3; ++layer) {
    for (int i = 0; i < kRow; ++i) {
      for (int j = 0; j < kRow; ++j) {
        const double shrink = 1.0 - 0.02 * ((7 * i + 5 * j + 3 * layer) % 10);
        const Vec3 centre(2.1 * kRadius * (i - 0.5 * kRow + 0.3 * layer),
                          2.1 * kRadius * (j - 0.5 * kRow + 0.4 * layer),
                          0.006 + 2.1 * kRadius * layer);
        scene.add_sphere(centre, shrink * kRadius, 2650.0, kFabric);
      }
    }
  }
  return scene;
}

}  // namespace

CaseReport validate(bool full) {
  const std::int64_t steps = full ? 20'000 : 3'000;
  CaseReport report;
  Figure figure{"Grains fall on a membrane: all numbers of threads on each other",
                "time (s)",
                "kinetic energy (J)",
                {}};
  std::uint64_t first = 0;
  for (const int threads : {1, 2, 4}) {
    dynamics::SimulationOptions options;
    options.motion.gravity = Vec3(0.0, 0.0, -9.81);
    options.threads = threads;
    dynamics::Simulation simulation(grains_over_a_sheet(), options);
    figure.curves.push_back({fmt::format("{} thread{}", threads, threads > 1 ? "s" : ""),
                             threads > 1 ? CurveStyle::dashed : CurveStyle::line,
                             {},
                             {}});
    while (simulation.steps() < steps) {
      simulation.step();
      if (simulation.steps() % (steps / 300) != 0) continue;
      figure.curves.back().x.push_back(simulation.time());
      figure.curves.back().y.push_back(simulation.energy().kinetic);
    }
    const std::uint64_t hash = dynamics::state_hash(simulation);
    if (threads == 1) {
      first = hash;
      continue;
    }
    report.findings.push_back(
        {fmt::format("bits that differ after {} steps with {} threads (0: none, 1: some)", steps,
                     threads),
         hash == first ? 0.0 : 1.0, 0.0, 0.0, "",
         fmt::format("one thread: hash of the state {:016x}", first)});
  }
  report.figures.push_back(std::move(figure));
  return report;
}

}  // namespace plekton::apps::determinism
