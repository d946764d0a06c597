// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/benchmarks/scenes/benchmark_scene.hpp"

#include <cstdint>

namespace plekton::benchmarks {

struct Window {
  int warm_up;  ///< steps before the clock starts, at least 0
  int steps;    ///< steps that are timed, at least 1
};

/// Figures by which a reader can tell that two codes computed the same motion. Of all nodes, those
/// of membranes and grids included.
struct StateFigures {
  double kinetic_energy;      ///< J, of the translation of free nodes
  double mean_height;         ///< m, each node counts the same
  double lowest_node;         ///< m
  double highest_node;        ///< m
  geometry::Vec3 held_force;  ///< N, of contacts and beams on all held nodes together
};

/// What a run cost, and where it ended.
struct Measurement {
  std::size_t elements;
  double wall;                      ///< s, of the timed steps
  double processor_time;            ///< s, of all threads together
  contact::ContactCounts contacts;  ///< after the last step
  std::int64_t list_rebuilds;       ///< of spheres and of structures, in the timed steps
  double skin;                      ///< m, of the spheres' lists after the last step
  StateFigures state;               ///< after the last step
};

/// Runs a scene. @throws what Simulation throws
Measurement measure(BenchmarkScene scene, const Window& window);

StateFigures state_figures(const BenchmarkSimulation& simulation);

inline std::size_t total(const contact::ContactCounts& counts) noexcept {
  return counts.sphere_sphere + counts.sphere_surface + counts.between_structures +
         counts.with_planes;
}

}  // namespace plekton::benchmarks
