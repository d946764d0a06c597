// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/checkpoints.hpp"

#include "apps/scenario/problems.hpp"
#include "dynamics/checkpoint/checkpoint_file.hpp"
#include "dynamics/output/file.hpp"
#include "geometry/base/state_archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

bool is_checkpoint(const std::string& name) {
  return name.starts_with("step_") && name.ends_with(".h5") &&
         name.find_first_not_of("0123456789", 5) == name.size() - 3;
}

/// So many digits that names sort by steps.
std::string name_of_checkpoint(std::int64_t steps) {
  return fmt::format("step_{:012}.h5", steps);
}

}  // namespace

void write_run_checkpoint(const fs::path& folder, std::int64_t steps,
                          const geometry::StateTree& state) {
  const fs::path below = folder / kCheckpointFolder;
  dynamics::ensure_output_folder(below);  // not those above it: they are gone if somebody took them
  dynamics::write_checkpoint(below / name_of_checkpoint(steps), state);
}

std::vector<fs::path> checkpoints_of(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder / kCheckpointFolder, ignored)) {
    if (is_checkpoint(entry.path().filename().string())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void remove_run_checkpoint(const fs::path& folder, std::int64_t steps) {
  std::error_code ignored;
  fs::remove(folder / kCheckpointFolder / name_of_checkpoint(steps), ignored);
}

void remove_checkpoints(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::path& file : checkpoints_of(folder)) fs::remove(file, ignored);
}

namespace {

/// The last one of some files that can be read and is not after a time.
/// @throws InputError naming what is wrong with those that cannot be read
std::optional<FoundCheckpoint> last_of(std::vector<fs::path> files,
                                       const std::optional<double>& not_after) {
  std::vector<std::string> damaged;
  for (; !files.empty(); files.pop_back()) {
    try {
      geometry::StateTree state = dynamics::read_checkpoint(files.back());
      if (not_after && time_of(state) > *not_after) continue;
      return FoundCheckpoint{files.back(), std::move(state), std::move(damaged)};
    } catch (const dynamics::CheckpointError& error) {
      damaged.emplace_back(error.what());
    }
  }
  if (!damaged.empty()) throw InputError(fmt::format("{}", fmt::join(damaged, "\n")));
  return std::nullopt;
}

}  // namespace

FoundCheckpoint last_checkpoint(const fs::path& folder, const std::optional<double>& not_after) {
  std::vector<fs::path> files = checkpoints_of(folder);
  if (files.empty())
    throw InputError(
        fmt::format("{}: has no checkpoints; a run writes them where its scenario says "
                    "checkpoint_interval in [output], when it is interrupted, and at its end",
                    folder.string()));
  if (auto found = last_of(std::move(files), not_after)) return std::move(*found);
  throw InputError(
      fmt::format("{}: its first checkpoint comes after {:.6g} s; ask for a later time",
                  folder.string(), *not_after));
}

FoundCheckpoint checkpoint_before(const fs::path& folder, std::int64_t step,
                                  const std::optional<double>& not_after) {
  std::vector<fs::path> files = checkpoints_of(folder);
  std::erase_if(files, [&](const fs::path& file) {
    return file.filename() >= fs::path(name_of_checkpoint(step));
  });
  if (auto found = last_of(std::move(files), not_after)) return std::move(*found);
  throw InputError(
      fmt::format("{}: there is no other checkpoint before step {}, to compute it from; expected "
                  "two of them: checkpoint_interval in [output] makes them",
                  folder.string(), step));
}

double time_of(const geometry::StateTree& state) {
  double time = 0.0;
  geometry::StateArchive::reader(state)("time", time);
  return time;
}

std::int64_t steps_of(const geometry::StateTree& state) {
  std::int64_t steps = 0;
  geometry::StateArchive::reader(state)("steps", steps);
  return steps;
}

}  // namespace plekton::apps
