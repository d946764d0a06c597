// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/models.hpp"
#include "dynamics/simulation.hpp"

#include <cstddef>

namespace plekton::benchmarks {

using BenchmarkSimulation = dynamics::Simulation;

/// A scene on which codes are compared, with everything that decides its cost.
struct BenchmarkScene {
  dynamics::Scene scene;
  dynamics::SimulationOptions options;
  std::size_t element_count;  ///< spheres, facets and free cylinders
  contact::ContactModel model = contact::linear_frictional();
};

}  // namespace plekton::benchmarks
