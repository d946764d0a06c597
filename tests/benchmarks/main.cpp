// SPDX-License-Identifier: GPL-3.0-or-later
// plekton-bench: runs a scene of given size and prints one JSON line about its cost.
#include "tests/benchmarks/scenes.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include <chrono>
#include <ctime>
#include <iostream>

namespace {

struct Options {
  std::string scene = "s1";
  std::string bed;
  int cells = 32;
  int threads = 1;
  int warm_up = 200;
  int steps = 2000;
};

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

nlohmann::ordered_json run(const Options& options) {
  namespace bench = plekton::benchmarks;
  const bench::Bed bed = bench::read_bed(options.bed);
  bench::BenchmarkScene made = options.scene == "s1"
                                   ? bench::sphere_bed(bed)
                                   : bench::spheres_on_membrane(bed, options.cells);
  made.options.threads = options.threads;
  plekton::dynamics::Simulation<plekton::contact::LinearFrictional> simulation(
      std::move(made.scene), made.options);

  for (int i = 0; i < options.warm_up; ++i) simulation.step();
  const double wall = wall_seconds();
  const double cpu = cpu_seconds();
  for (int i = 0; i < options.steps; ++i) simulation.step();
  const double per_step = 1e3 / options.steps;
  const auto counts = simulation.contacts().counts();
  return {{"scene", options.scene},
          {"N", made.element_count},
          {"threads", options.threads},
          {"steps", options.steps},
          {"ms_per_step", per_step * (wall_seconds() - wall)},
          {"cpu_ms_per_step", per_step * (cpu_seconds() - cpu)},
          {"contacts", counts.sphere_sphere + counts.sphere_surface + counts.with_planes},
          {"list_rebuilds", simulation.contacts().neighbours().rebuild_count()},
          {"rss_MiB", peak_memory_mib()}};
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"Times the step of a benchmark scene; prints one JSON line."};
  app.add_option("scene", options.scene, "s1: sphere bed; s2: spheres on a membrane")
      ->required()
      ->check(CLI::IsMember({"s1", "s2"}));
  app.add_option("--bed", options.bed, "packing of spheres (see tests/benchmarks/README.md)")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--cells", options.cells, "s2: squares along a side")->check(CLI::PositiveNumber);
  app.add_option("--threads", options.threads)->check(CLI::PositiveNumber);
  app.add_option("--warm-up", options.warm_up, "steps before the clock starts")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--steps", options.steps, "steps that are timed")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    std::cout << run(options).dump() << '\n';
  } catch (const std::exception& error) {
    std::cerr << "plekton-bench: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
