// SPDX-License-Identifier: GPL-3.0-or-later
// plekton-stress: random scenes through all that reads and runs scenario files, each checked from
// outside, and prints what it saw. Exit code 0: nothing wrong, 1: a failure, 2: a command line that
// cannot be understood.
#include "tests/stress/stress.hpp"

#include <CLI/CLI.hpp>

#include <iostream>

int main(int argc, char** argv) {
  using namespace plekton::stress;
  StressOptions options;
  double minutes = 1.0;
  long long shrinking = options.shrinking.count();
  std::string scene;
  CLI::App app{
      "Runs random scenes and checks each of them: finite, momentum, energy, threads, restart, and "
      "that check and run agree. A failing one is written as a scenario file, shrunk."};
  app.add_option("--minutes", minutes, "for how long")->capture_default_str();
  app.add_option("--scenes", options.scenes, "how many, instead of a time");
  app.add_option("--seed", options.seed, "of the random scenes")->capture_default_str();
  app.add_option("--first", options.first, "number of the first scene")->capture_default_str();
  app.add_option("--steps", options.steps, "of a scene, about, at most")->capture_default_str();
  app.add_option("--shrink", shrinking, "s, to shrink one failure at most")->capture_default_str();
  app.add_option("--out", options.out, "folder for scenes that fail")->capture_default_str();
  app.add_option("--scene", scene, "one scenario file, instead of random scenes")
      ->check(CLI::ExistingFile);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  options.time = std::chrono::duration<double>(60.0 * minutes);
  options.shrinking = std::chrono::seconds(shrinking);
  const Tally tally =
      scene.empty() ? stress(options, std::cout) : stress_file(scene, options, std::cout);
  std::cout << table_of(tally);
  return tally.failed == 0 ? 0 : 1;
}
