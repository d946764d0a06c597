// SPDX-License-Identifier: GPL-3.0-or-later
// plekton-bench-pull-out: the bed of the validation case pull_out, settled, and a lattice pulled out of it by 12 mm. Prints one JSON
// line with the time it took; peers/yade_pull_out.py is the same scene for YADE, pull_out.py runs both in turns.
#include "apps/validation/pull_out_bed.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdint>
#include <ctime>
#include <exception>
#include <iostream>
#include <string>

namespace {

namespace pull_out = plekton::apps::pull_out;

struct Options {
  std::string kind = "membrane";
  std::uint64_t seed = 3;
  double time_step = 0.0;  // s
};

nlohmann::ordered_json run(const Options& options) {
  const auto kind = options.kind == "grid" ? pull_out::Kind::grid : pull_out::Kind::membrane;
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t processor = std::clock();
  const pull_out::PullOut pull = pull_out::pulled_out(kind, options.seed, options.time_step);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  return {{"kind", options.kind},
          {"grains", pull.grains},
          {"steps", pull.steps},
          {"wall_s", wall.count()},
          {"cpu_s", static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC},
          {"share", pull.mean}};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Pulls a lattice out of a bed of grains and prints one JSON line."};
  Options options;
  app.add_option("kind", options.kind)->check(CLI::IsMember({"membrane", "grid"}));
  app.add_option("--seed", options.seed, "of the bed");
  app.add_option("--time-step", options.time_step, "s; 0: the program chooses")
      ->check(CLI::NonNegativeNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    std::cout << run(options).dump() << '\n';
  } catch (const std::exception& error) {
    std::cerr << "plekton-bench-pull-out: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
