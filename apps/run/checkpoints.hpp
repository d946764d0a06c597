// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/state_tree.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The checkpoints of a run: files in a folder of its own below that of the run, one for each step
/// at which one was written.
namespace plekton::apps {

inline constexpr const char* kCheckpointFolder = "checkpoints";

/// Why a checkpoint is there; its name tells.
enum class CheckpointKind : std::uint8_t {
  stays,    ///< step_N.h5
  by_clock  ///< step_N_clock.h5, until the next one comes (ClockCheckpoints)
};

/// @param folder  of the run
/// @throws dynamics::OutputError
void write_run_checkpoint(const std::filesystem::path& folder, std::int64_t steps,
                          const geometry::StateTree& state,
                          CheckpointKind kind = CheckpointKind::stays);

/// Whether a file of this name in the folder of checkpoints is one.
bool is_checkpoint(std::string_view name);
/// Of what kind a file is, by its name.
bool is_by_clock(const std::filesystem::path& checkpoint);

/// Files of a run, in the order of their steps.
std::vector<std::filesystem::path> checkpoints_of(const std::filesystem::path& folder);
/// Those by the clock, but for that of a step. What cannot be removed stays.
void remove_clock_checkpoints(const std::filesystem::path& folder,
                              std::optional<std::int64_t> but = std::nullopt);
/// Those that come after a step, from which the run goes on.
void remove_checkpoints_after(const std::filesystem::path& folder, std::int64_t steps);
/// Those of an earlier run. What cannot be removed will be replaced.
void remove_checkpoints(const std::filesystem::path& folder);

/// A checkpoint that can be read.
struct FoundCheckpoint {
  std::filesystem::path file;
  geometry::StateTree state;
  /// What is wrong with later ones: they cannot be read, or go on with files that are not there.
  std::vector<std::string> damaged;
};
/// What is wrong with later checkpoints, and that this one is taken instead; empty if it is the
/// last.
std::vector<std::string> warnings_about(const FoundCheckpoint& checkpoint);

/// The last one of a run, or the last one not after the step in which a time (s) lies: checkpoints
/// are written at the first step after the time that they are due.
/// @throws InputError if there is none, with what is wrong with those that cannot be read
FoundCheckpoint last_checkpoint(const std::filesystem::path& folder,
                                const std::optional<double>& time = std::nullopt);

/// The last one of a run with whose histories it can go on: each has as many bytes as it had then.
/// @throws InputError if there is none, with what is wrong with those that there are
FoundCheckpoint last_checkpoint_with_files(const std::filesystem::path& folder);

/// The last one before a step, and not after that in which a time (s) lies.
/// @throws InputError if there is none
FoundCheckpoint checkpoint_before(const std::filesystem::path& folder, std::int64_t step,
                                  const std::optional<double>& time);

/// s, of a state.
double time_of(const geometry::StateTree& state);
/// How many steps it has had.
std::int64_t steps_of(const geometry::StateTree& state);

}  // namespace plekton::apps
