// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace plekton::apps {

/// What commands are told about a scenario.
struct ScenarioOptions {
  std::filesystem::path file;          ///< "-": standard input
  std::vector<std::string> overrides;  ///< "path=value" each
  std::optional<int> threads;
};

/// @returns that for the file
CLI::Option* add_scenario_options(CLI::App& command, ScenarioOptions& options);

/// --threads alone, for a command that finds the scenario elsewhere.
void add_threads_option(CLI::App& command, ScenarioOptions& options);

/// With the threads that are asked for.
std::vector<std::string> overrides_of(const ScenarioOptions& options);

/// Reads it. @throws InputError
Scenario scenario_of(const ScenarioOptions& options);

}  // namespace plekton::apps
