// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/scenario_options.hpp"

#include "apps/scenario/scenario_reader.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace plekton::apps {

CLI::Option* add_scenario_options(CLI::App& command, ScenarioOptions& options) {
  CLI::Option* const file = command.add_option(
      "scenario", options.file,
      "Scenario file (.toml), or - for standard input: the mesh files it names are then "
      "relative to the current folder; apps/scenario.md documents its keys");
  command
      .add_option("--set", options.overrides,
                  "Replace a value, as in simulation.duration=\"1 s\"; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  add_threads_option(command, options);
  return file;
}

void add_threads_option(CLI::App& command, ScenarioOptions& options) {
  command.add_option("--threads", options.threads, "Threads; the result does not depend on it")
      ->check(CLI::Range(1, 1024));
}

std::vector<std::string> overrides_of(const ScenarioOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  if (options.threads) overrides.push_back(fmt::format("simulation.threads={}", *options.threads));
  return overrides;
}

Scenario scenario_of(const ScenarioOptions& options) {
  return read_scenario(options.file, overrides_of(options));
}

}  // namespace plekton::apps
