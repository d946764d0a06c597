// SPDX-License-Identifier: GPL-3.0-or-later
// plekton-bench: runs a scene and prints one JSON line about its cost, or makes a bed. Started by mpirun its processes run the scene
// together.
#include "contact/among_ranks.hpp"
#include "tests/benchmarks/measurement.hpp"
#include "tests/benchmarks/scenes/laws.hpp"
#include "tests/benchmarks/scenes/scene_table.hpp"

#ifdef PLEKTON_HAS_DISTRIBUTED
#include "dynamics/distributed/mpi_job.hpp"
#endif

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include <fstream>
#include <iostream>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace bench = plekton::benchmarks;

struct RunOptions {
  bool lists = false;
  std::string scene;
  std::string law = "linear_frictional";
  std::string bed;
  std::optional<std::size_t> spheres;
  int copies = 1;
  int cells = 32;
  int threads = 1;
  std::optional<int> warm_up;
  std::optional<int> steps;
  double skin = 0.0;
};

struct BedOptions {
  bench::BedOrder order;
  bool is_flow = false;
  bool is_slab = false;
  int copies = 1;
  std::string out;
};

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

bench::SceneInput input_of(const bench::SceneEntry& entry, const RunOptions& options) {
  bench::SceneInput input{{}, options.cells};
  if (!entry.bed) return input;
  if (!options.bed.empty()) {
    input.bed = bench::read_bed(options.bed);
  } else {
    const std::size_t spheres = options.spheres.value_or(entry.spheres);
    std::cerr << "plekton-bench: no bed given; making one of " << spheres << " spheres\n";
    input.bed = bench::make_bed({*entry.bed, spheres, 1, options.threads}, std::cerr);
  }
  if (options.copies > 1) input.bed = side_by_side(input.bed, options.copies);
  return input;
}

nlohmann::ordered_json to_json(const bench::StateFigures& state) {
  return {{"kinetic_energy_J", state.kinetic_energy},
          {"mean_height_m", state.mean_height},
          {"lowest_node_m", state.lowest_node},
          {"highest_node_m", state.highest_node},
          {"held_force_N", {state.held_force.x(), state.held_force.y(), state.held_force.z()}}};
}

nlohmann::ordered_json to_json(const plekton::contact::ContactCounts& counts) {
  return {{"sphere_sphere", counts.sphere_sphere},
          {"sphere_surface", counts.sphere_surface},
          {"between_structures", counts.between_structures},
          {"with_planes", counts.with_planes}};
}

/// s, of all ranks together.
double processor_time_of_all(plekton::geometry::Ranks* ranks, double own) {
  if (ranks == nullptr) return own;
  const auto count = static_cast<std::size_t>(ranks->count());
  std::vector<double> times(count, 0.0);
  times[static_cast<std::size_t>(ranks->rank())] = own;
  ranks->gather(std::as_writable_bytes(std::span(times)),
                std::vector<std::size_t>(count, sizeof(double)));
  return std::accumulate(times.begin(), times.end(), 0.0);
}

/// @param ranks  that run it together, or none
nlohmann::ordered_json run(const RunOptions& options, plekton::geometry::Ranks* ranks) {
  const bench::SceneEntry& entry = bench::find_scene(options.scene);
  bench::BenchmarkScene scene = entry.make(input_of(entry, options));
  bench::set_law(options.law, scene);
  if (ranks != nullptr) scene.model = plekton::contact::among_ranks(scene.model, *ranks);
  scene.options.threads = options.threads;
  scene.options.skin = options.skin;
  const bench::Window window{options.warm_up.value_or(entry.warm_up),
                             options.steps.value_or(entry.steps)};
  const bench::Measurement result = bench::measure(std::move(scene), window);

  const double steps_per_second = window.steps / result.wall;
  const std::size_t contacts = bench::total(result.contacts);
  return {{"scene", entry.name},
          {"law", options.law},
          {"N", result.elements},
          {"threads", options.threads},
          {"ranks", ranks == nullptr ? 0 : ranks->count()},
          {"warm_up", window.warm_up},
          {"steps", window.steps},
          {"ms_per_step", 1e3 * result.wall / window.steps},
          {"cpu_ms_per_step",
           1e3 * processor_time_of_all(ranks, result.processor_time) / window.steps},
          {"element_steps_per_s", static_cast<double>(result.elements) * steps_per_second},
          {"contacts", contacts},
          {"contacts_by_kind", to_json(result.contacts)},
          {"contact_evaluations_per_s", static_cast<double>(contacts) * steps_per_second},
          {"list_rebuilds", result.list_rebuilds},
          {"skin_m", result.skin},
          {"rss_MiB", peak_memory_mib()},
          {"state", to_json(result.state)}};
}

/// Runs a scene, alone or as one of several processes, of which the first prints what came of it.
void run_and_print(const RunOptions& options) {
#ifdef PLEKTON_HAS_DISTRIBUTED
  if (plekton::distributed::is_one_of_several()) {
    plekton::distributed::MpiJob job;
    const nlohmann::ordered_json figures = run(options, &job.ranks());
    if (job.ranks().rank() == 0) std::cout << figures.dump() << '\n';
    return;
  }
#endif
  std::cout << run(options, nullptr).dump() << '\n';
}

void make_bed(const BedOptions& options) {
  // Settling may take minutes: see first whether its result can be kept.
  if (!std::ofstream(options.out, std::ios::app))
    throw std::runtime_error(options.out + ": cannot be written");
  bench::BedOrder order = options.order;
  if (options.is_flow) order.kind = bench::BedKind::flow;
  if (options.is_slab) order.kind = bench::BedKind::slab;
  const bench::Bed bed = bench::make_bed(order, std::cerr);
  write_bed(options.copies > 1 ? side_by_side(bed, options.copies) : bed, options.out);
}

void add_run_options(CLI::App& app, RunOptions& options) {
  app.add_option("scene", options.scene, "see --list");
  app.add_option("--law", options.law, "of all contacts; with +parts also rolling and a dashpot")
      ->check(CLI::IsMember(bench::law_names()));
  app.add_option("--bed", options.bed, "packing of spheres; without it one is made")
      ->check(CLI::ExistingFile);
  app.add_option("--spheres", options.spheres, "of the bed that is made")
      ->check(CLI::PositiveNumber)
      ->excludes("--bed");
  app.add_option("--copies", options.copies, "this many beds side by side, along x and y each")
      ->check(CLI::PositiveNumber);
  app.add_option("--cells", options.cells, "s2: squares along a side")->check(CLI::Range(2, 10000));
  app.add_option("--threads", options.threads)->check(CLI::PositiveNumber);
  app.add_option("--warm-up", options.warm_up, "steps before the clock starts")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--steps", options.steps, "steps that are timed")->check(CLI::PositiveNumber);
  app.add_option("--skin", options.skin, "m, of the lists of pairs; 0: the program chooses")
      ->check(CLI::NonNegativeNumber);
  app.add_flag("--list", options.lists, "prints the scenes");
}

void add_bed_options(CLI::App& app, BedOptions& options) {
  app.add_option("--spheres", options.order.spheres)->required()->check(CLI::PositiveNumber);
  auto* flow = app.add_flag("--flow", options.is_flow, "for s1flow: caught while it collapses");
  app.add_flag("--slab", options.is_slab, "for s2: some 5 spheres deep")->excludes(flow);
  app.add_option("--seed", options.order.seed);
  app.add_option("--threads", options.order.threads)->check(CLI::PositiveNumber);
  app.add_option("--copies", options.copies, "this many beds side by side, along x and y each")
      ->check(CLI::PositiveNumber);
  app.add_option("--out", options.out, "file to write")->required();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Times the step of a benchmark scene and prints one JSON line."};
  RunOptions run_options;
  add_run_options(app, run_options);
  BedOptions bed_options;
  CLI::App* bed_command =
      app.add_subcommand("make-bed", "Lets spheres settle and writes them to a file.");
  add_bed_options(*bed_command, bed_options);
  CLI11_PARSE(app, argc, argv);
  try {
    if (bed_command->parsed()) {
      make_bed(bed_options);
    } else if (run_options.lists) {
      std::cout << bench::list_of_scenes();
    } else if (run_options.scene.empty()) {
      throw std::invalid_argument("name a scene, or make-bed:\n" + bench::list_of_scenes());
    } else {
      run_and_print(run_options);
    }
  } catch (const std::exception& error) {
    std::cerr << "plekton-bench: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
