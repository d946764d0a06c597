// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/benchmarks/scenes/benchmark_scene.hpp"

namespace plekton::benchmarks {

/// What lies beneath a layer.
enum class Ground {
  sheet,   ///< a membrane of cells as wide as those of spheres_on_membrane()
  spheres  ///< one beneath each of the layer
};

/// A layer of spheres that do not touch each other, each on its own on the ground, pressed on it by
/// its weight; all of them and the ground's nodes move along the layer at random, up to 0.05 m/s,
/// for as long as 800 steps without structure pair. So every contact slides or rolls, and lists
/// are made anew as in a bed that moves. Numerical damping 0.3.
/// @param height  m, by which the layer is lifted; 0: 4096 contacts, 3 mm: none, and none listed.
///                Of two such runs the difference in cost is that of the contacts
BenchmarkScene layer_of_spheres(Ground ground, double height);

}  // namespace plekton::benchmarks
