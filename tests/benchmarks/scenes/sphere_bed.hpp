// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/benchmarks/bed.hpp"
#include "tests/benchmarks/scenes/benchmark_scene.hpp"

namespace plekton::benchmarks {

/// Spheres in a box with four walls and a floor, under gravity, numerical damping 0.2. The box is
/// bed.extent times as long as wide: with 1 the bed rests, with more it collapses.
BenchmarkScene sphere_bed(const Bed& bed);

}  // namespace plekton::benchmarks
