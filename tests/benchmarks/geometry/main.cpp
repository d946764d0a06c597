// SPDX-License-Identifier: GPL-3.0-or-later
// plekton-bench-geometry: what the geometry kernel costs, as JSON lines: nearest points of a point
// and a triangle certified over those in plain double, the broad phase's share of a step, the
// import of a large mesh.
#include "tests/benchmarks/geometry/broad_phase_share.hpp"
#include "tests/benchmarks/geometry/certified_ratio.hpp"
#include "tests/benchmarks/geometry/import_time.hpp"

#include <CLI/CLI.hpp>

#include <iostream>

int main(int argc, char** argv) {
  int spheres = 100000;
  int facets = 100000;
  CLI::App app{"Times the geometry kernel; prints JSON lines."};
  app.add_option("--spheres", spheres, "of the scene whose broad phase is timed")
      ->capture_default_str()
      ->check(CLI::Range(100, 10000000));
  app.add_option("--facets", facets, "of the mesh that is imported")
      ->capture_default_str()
      ->check(CLI::Range(100, 10000000));
  CLI11_PARSE(app, argc, argv);
  try {
    for (const auto& line : plekton::benchmarks::certified_ratios())
      std::cout << line.dump() << '\n';
    std::cout << plekton::benchmarks::import_time(facets).dump() << '\n';
    for (const double speed : {0.03, 0.1, 0.3})
      std::cout << plekton::benchmarks::broad_phase_share(spheres, speed).dump() << '\n';
  } catch (const std::exception& error) {
    std::cerr << "plekton-bench-geometry: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
