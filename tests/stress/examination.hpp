// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/simulation.hpp"
#include "tests/stress/findings.hpp"
#include "tests/support/sanitized.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace plekton::stress {

/// Which run of an examination.
enum class Part : std::uint8_t { check, run, two_threads, three_threads, restart };

struct ExaminationOptions {
  /// Meshes are found relative to the folder of this file, which need not be there.
  std::filesystem::path file = "scene.toml";
  /// Only what shows this fault is looked at, as a shrinking scene needs it; nothing: all.
  std::optional<Fault> only;
  /// s, of processor time, after which a scene hangs.
  int processor_time = 120 * test::kSlowedDown;
  /// Called after every step, so that a test can do harm to a run.
  std::function<void(dynamics::Simulation&, Part)> disturb;
};

/// Checks a scenario file in a process of its own, which may crash: as `plekton check` and
/// `plekton run` would do it, on one, two and three threads, and from a checkpoint in its middle.
/// @param scenario  the text of the file
Findings examine(const std::string& scenario, const ExaminationOptions& options = {});

/// s, a duration of about so many steps; nothing where the scene is refused or takes fewer.
std::optional<double> shorter_duration(const std::string& scenario, std::int64_t steps,
                                       const ExaminationOptions& options = {});

}  // namespace plekton::stress
