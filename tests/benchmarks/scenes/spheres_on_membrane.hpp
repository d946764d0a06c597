// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/benchmarks/bed.hpp"
#include "tests/benchmarks/scenes/benchmark_scene.hpp"

namespace plekton::benchmarks {

/// Spheres on a square sheet held at its rim, between four walls; numerical damping 0.3.
/// @param cells  squares along a side, at least 2, each of two facets cut in alternating directions
BenchmarkScene spheres_on_membrane(const Bed& bed, int cells);

}  // namespace plekton::benchmarks
