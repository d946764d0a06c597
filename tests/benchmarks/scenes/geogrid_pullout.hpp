// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/benchmarks/bed.hpp"
#include "tests/benchmarks/scenes/benchmark_scene.hpp"

namespace plekton::benchmarks {

/// A geogrid pulled through a bed: bars of radius 0.4 mm, 4 mm apart, each of two cylinders between
/// junctions, laid at half the number of spheres; those above are lifted to make room for it. The
/// nodes of its far side move along x with 0.1 m/s and do not turn. Numerical damping 0.3.
/// @throws std::invalid_argument if the box is too narrow for an aperture (8 mm)
BenchmarkScene geogrid_pullout(const Bed& bed);

}  // namespace plekton::benchmarks
