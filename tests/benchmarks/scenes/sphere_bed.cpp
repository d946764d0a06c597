// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/scenes/sphere_bed.hpp"

#include "tests/benchmarks/scenes/parts.hpp"

namespace plekton::benchmarks {

BenchmarkScene sphere_bed(const Bed& bed) {
  BenchmarkScene result = empty_scene(0.2);
  add_spheres(bed, result.scene);
  add_walls({bed.side * bed.extent, bed.side}, result.scene);
  add_floor(kCommonMaterial, result.scene);
  result.element_count = bed.grains.size();
  return result;
}

}  // namespace plekton::benchmarks
