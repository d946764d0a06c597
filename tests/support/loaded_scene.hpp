// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/scene_check.hpp"
#include "dynamics/simulation.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/membrane.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// Small scenes for loads.
namespace plekton::test {

using dynamics::Scene;
using geometry::NodeId;
using geometry::Vec3;
using LoadedSimulation = dynamics::Simulation;

/// A node of 2 kg and 0.1 kg m² without any element.
inline NodeId add_lump(Scene& scene, const Vec3& place) {
  const NodeId node = scene.add_node(place);
  scene.properties.mass.back() = 2.0;
  scene.properties.inertia.back() = 0.1;
  return node;
}

inline LoadedSimulation simulation_of(Scene scene, double time_step,
                                      const Vec3& gravity = Vec3::Zero(), int threads = 1) {
  dynamics::SimulationOptions options;
  options.time_step = time_step;
  options.motion.gravity = gravity;
  options.threads = threads;
  return LoadedSimulation(std::move(scene), options);
}

inline std::string problems_of(const Scene& scene) {
  try {
    dynamics::check(scene);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

/// Adds the facets of a mesh, with beams of 4 mm along their sides.
/// @returns the facets
inline std::vector<geometry::FaceId> add_membrane(Scene& scene, const geometry::Mesh& mesh) {
  const std::size_t first = scene.state.size();
  const auto node = [&](NodeId point) { return geometry::id_at<NodeId>(first + index_of(point)); };
  for (const Vec3& point : mesh.points) scene.add_node(point);
  const auto section = dynamics::circular_section(0.002, 1e7, 0.3);
  for (const auto& [a, b] : geometry::make_membrane(mesh, {.thickness = 0.004}).edges)
    scene.add_beam(node(a), node(b), section, 1000.0);
  std::vector<geometry::FaceId> facets;
  for (const auto& [a, b, c] : mesh.facets) {
    facets.push_back(geometry::id_at<geometry::FaceId>(scene.elements.facets.size()));
    scene.add_facet(node(a), node(b), node(c), 0.002, contact::MaterialId{0});
  }
  return facets;
}

/// Steps until a time and looks at the books at every step.
/// @returns the largest closure error over the largest turnover
inline double closure_until(LoadedSimulation& simulation, double time) {
  double error = 0.0;
  double turnover = 0.0;
  while (simulation.time() < time) {
    simulation.step();
    const dynamics::Energy energy = simulation.energy();
    error = std::max(error, std::abs(energy.closure_error()));
    turnover = std::max(turnover, energy.turnover());
  }
  return error / turnover;
}

}  // namespace plekton::test
