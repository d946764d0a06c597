// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/simulation.hpp"
#include "tests/benchmarks/bed.hpp"

namespace plekton::benchmarks {

/// A scene on which codes are compared, with everything that decides its cost.
struct BenchmarkScene {
  dynamics::Scene scene;
  dynamics::SimulationOptions options;
  std::size_t element_count;  ///< spheres + facets
};

/// Spheres in a box with four walls and a floor, under gravity. E 2 MPa, tangential stiffness ratio
/// 2/7, friction 0.5, 2500 kg/m³, step 4e-6 s, numerical damping 0.2, skin 0.1 mm.
BenchmarkScene sphere_bed(const Bed& bed);

/// Spheres on a square sheet held at its rim, between four walls: cells x cells squares of two
/// facets in alternating directions, radius 0.3 mm, beams of E 50 MPa and 3000 kg/m³; numerical
/// damping 0.3.
BenchmarkScene spheres_on_membrane(const Bed& bed, int cells);

}  // namespace plekton::benchmarks
