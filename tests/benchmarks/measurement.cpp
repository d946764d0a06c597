// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neighbor/cell_neighbours.hpp"
#include "geometry/neighbor/neighbours.hpp"
#include "tests/benchmarks/measurement.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>
#include <utility>

namespace plekton::benchmarks {
namespace {

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace

StateFigures state_figures(const BenchmarkSimulation& simulation) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  StateFigures figures{0.0, 0.0, kInfinity, -kInfinity, geometry::Vec3::Zero()};
  const auto& state = simulation.state();
  const auto& properties = simulation.properties();
  for (std::size_t i = 0; i < state.size(); ++i) {
    const double height = state.position[i].z();
    figures.mean_height += height / static_cast<double>(state.size());
    figures.lowest_node = std::min(figures.lowest_node, height);
    figures.highest_node = std::max(figures.highest_node, height);
    if (dynamics::holds_translation(properties.held[i])) {
      figures.held_force += simulation.forces().force[i];
    } else {
      figures.kinetic_energy += 0.5 * properties.mass[i] * state.velocity[i].squaredNorm();
    }
  }
  return figures;
}

Measurement measure(BenchmarkScene scene, const Window& window) {
  BenchmarkSimulation simulation(std::move(scene.scene), scene.options, scene.model);
  const auto& contacts = simulation.contacts();
  const auto rebuilds = [&] {
    return contacts.neighbours().rebuild_count() + contacts.cell_neighbours().rebuild_count();
  };

  for (int i = 0; i < window.warm_up; ++i) simulation.step();
  const std::int64_t rebuilds_before = rebuilds();
  const double wall_before = wall_seconds();
  const double processor_before = processor_seconds();
  for (int i = 0; i < window.steps; ++i) simulation.step();
  const double wall = wall_seconds() - wall_before;
  const double processor_time = processor_seconds() - processor_before;

  return {scene.element_count,
          wall,
          processor_time,
          contacts.counts(),
          rebuilds() - rebuilds_before,
          contacts.neighbours().skin(),
          state_figures(simulation)};
}

}  // namespace plekton::benchmarks
