// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/benchmarks/scenes/benchmark_scene.hpp"

namespace plekton::benchmarks {

/// A boulder of 500 kg and radius 0.5 m falls at 5 m/s into a net of 60 x 60 square meshes of 50
/// mm, held at its rim: wires of 2.7 mm, 10 GPa and 7850 kg/m³, contacts of 100 MPa. It starts 5 mm
/// above the net, which wraps around it as it comes to rest. Numerical damping 0.1.
BenchmarkScene boulder_in_net();

}  // namespace plekton::benchmarks
