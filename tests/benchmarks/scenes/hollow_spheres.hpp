// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/benchmarks/scenes/benchmark_scene.hpp"

namespace plekton::benchmarks {

/// A hollow sphere of 1280 facets and radius 20 mm, 1 mm above a floor and falling at 0.5 m/s;
/// numerical damping 0.3.
BenchmarkScene hollow_sphere_on_floor();

/// 20 hollow spheres of 320 facets and radius 10 mm, stacked 2 x 2 x 5 in a box, 0.05 mm apart;
/// each flies at its neighbours at 0.2 m/s along x and y, and down the faster the higher it is (0.2
/// to 1 m/s). Any may touch any and itself. Numerical damping 0.3.
BenchmarkScene colliding_hollow_spheres();

}  // namespace plekton::benchmarks
