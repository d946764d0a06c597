// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/scenario_options.hpp"
#include "apps/run/progress.hpp"
#include "apps/run/run.hpp"
#include "geometry/base/ranks.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plekton::apps {

/// What `plekton run` was asked for.
struct RunArguments {
  ScenarioOptions scenario;
  std::filesystem::path resume;   ///< folder of the run to go on with; empty: a scenario is run
  std::vector<std::string> from;  ///< a stage and the folder of its run, or with `resume` a time
  std::string until;              ///< name of the last stage; empty: all
  std::string to;                 ///< a time, with `resume`; empty: to the end
  std::filesystem::path out;      ///< empty: that of the run, or of the name of the scenario
  bool overwrite = false;         ///< replace results of an earlier run there
  bool strict = false;            ///< fail if anything in the certificate is red
  bool quiet = false;
  geometry::Ranks* ranks = nullptr;  ///< that compute a run together; nothing: this process
};

/// Which part of a run is made, and where.
struct PartOfRun {
  std::filesystem::path out;
  Progress::Clock::time_point began;   ///< when the work on it began
  const Resumption* resume = nullptr;  ///< a state to go on from; nothing: from the beginning
  std::optional<double> until = {};    ///< s; nothing: to the end
};

/// Runs a scenario, also one with stages, and says on standard output how it goes and how it has
/// ended.
/// @returns an ExitCode
/// @throws InputError, and as run()
int run_aloud(const RunArguments& arguments, const Scenario& scenario, const PartOfRun& part);

}  // namespace plekton::apps
