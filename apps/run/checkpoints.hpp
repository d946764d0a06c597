// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/state_tree.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// The checkpoints of a run: files in a folder of its own below that of the run, one for each step
/// at which one was written.
namespace plekton::apps {

inline constexpr const char* kCheckpointFolder = "checkpoints";

/// @param folder  of the run
/// @throws dynamics::OutputError
void write_run_checkpoint(const std::filesystem::path& folder, std::int64_t steps,
                          const geometry::StateTree& state);

/// Files of a run, in the order of their steps.
std::vector<std::filesystem::path> checkpoints_of(const std::filesystem::path& folder);
/// One of them. What cannot be removed stays.
void remove_run_checkpoint(const std::filesystem::path& folder, std::int64_t steps);
/// Those of an earlier run. What cannot be removed will be replaced.
void remove_checkpoints(const std::filesystem::path& folder);

/// A checkpoint that can be read.
struct FoundCheckpoint {
  std::filesystem::path file;
  geometry::StateTree state;
  std::vector<std::string> damaged;  ///< what is wrong with later ones that cannot be read
};
/// The last one of a run, or the last one not after a time (s).
/// @throws InputError if there is none, with what is wrong with those that cannot be read
FoundCheckpoint last_checkpoint(const std::filesystem::path& folder,
                                const std::optional<double>& not_after = std::nullopt);

/// The last one before a step, and not after a time (s).
/// @throws InputError if there is none
FoundCheckpoint checkpoint_before(const std::filesystem::path& folder, std::int64_t step,
                                  const std::optional<double>& not_after);

/// s, of a state.
double time_of(const geometry::StateTree& state);
/// How many steps it has had.
std::int64_t steps_of(const geometry::StateTree& state);

}  // namespace plekton::apps
