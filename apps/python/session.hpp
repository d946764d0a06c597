// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/resumed_run.hpp"
#include "apps/python/attendant.hpp"
#include "apps/run/run.hpp"
#include "dynamics/simulation.hpp"
#include "geometry/base/state_tree.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plekton::python {

/// A scenario in motion, as Python has it. Whatever is handed out as a view shares prepared(), so
/// that its memory stays while anybody looks at it.
class Session {
 public:
  /// Builds the scene. @throws InputError as the program says it
  explicit Session(apps::Scenario scenario);
  /// Goes on from a checkpoint.
  /// @param folder  of the run that it belongs to, if its results may go on
  Session(apps::ResumedRun resumed, std::optional<std::filesystem::path> folder);

  const apps::Scenario& scenario() const noexcept { return scenario_; }
  const std::shared_ptr<apps::PreparedRun>& prepared() const noexcept { return prepared_; }
  /// For what must not happen while another thread runs it. @throws std::logic_error
  dynamics::Simulation& simulation() const;
  /// For what moves it: nor from a function that a run calls. @throws std::logic_error
  void require_at_rest() const;

  /// Runs without writing anything, to a time (s) or until it is stopped.
  void run(double until, Attendant& attendant);
  /// As many steps, or until it is stopped.
  void step(std::int64_t count, Attendant& attendant);
  /// Runs as `plekton run` does, with results in a folder: from the start, or from the checkpoint
  /// that it goes on from.
  apps::RunReport run_into(const std::filesystem::path& folder, double until, bool overwrite,
                           Attendant& attendant);
  void stop() noexcept;

  /// A checkpoint with the scenario, for restore() and resume.
  void save(const std::filesystem::path& file) const;
  /// Takes the state of a checkpoint of the same scene. Views of before keep what they show.
  void restore(const std::filesystem::path& file);

  /// Writes a page that shows the run, or if it has written no results, the state of now.
  /// @returns  where
  std::filesystem::path view(const std::optional<std::filesystem::path>& out) const;

 private:
  /// While it lives, the simulation moves.
  class Moving;
  std::shared_ptr<apps::PreparedRun> prepare() const;
  void write_frame(const std::filesystem::path& folder) const;

  apps::Scenario scenario_;
  std::shared_ptr<apps::PreparedRun> prepared_;
  std::optional<apps::FoundCheckpoint> checkpoint_;  ///< that it went on from
  std::optional<std::filesystem::path> origin_;      ///< folder of the run that checkpoint_ is of
  std::optional<std::filesystem::path> folder_;      ///< of results
  Attendant* attendant_ = nullptr;                   ///< while it moves
};

}  // namespace plekton::python
