// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/checkpoints.hpp"

#include "apps/run/build_info.hpp"
#include "apps/run/output_folder.hpp"
#include "apps/run/run_state.hpp"
#include "apps/scenario/problems.hpp"
#include "dynamics/checkpoint/checkpoint_file.hpp"
#include "dynamics/output/file.hpp"
#include "dynamics/output/sync.hpp"
#include "geometry/base/state_archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBegin = "step_";
constexpr std::string_view kEnd = ".h5";
constexpr std::string_view kClockEnd = "_clock.h5";

/// So many digits that names sort by steps, and of two of the same step that which stays is first.
std::string name_of_checkpoint(std::int64_t steps, CheckpointKind kind = CheckpointKind::stays) {
  return fmt::format("{}{:012}{}", kBegin, steps, kind == CheckpointKind::stays ? kEnd : kClockEnd);
}

}  // namespace

bool is_checkpoint(std::string_view name) {
  if (!name.starts_with(kBegin)) return false;
  const std::string_view end =
      name.substr(std::min(name.find_first_not_of("0123456789", kBegin.size()), name.size()));
  return end == kEnd || end == kClockEnd;
}

void write_run_checkpoint(const fs::path& folder, std::int64_t steps,
                          const geometry::StateTree& state, CheckpointKind kind) {
  const fs::path below = folder / kCheckpointFolder;
  std::error_code ignored;
  const bool is_first = !fs::exists(below, ignored);
  dynamics::ensure_output_folder(below);  // not those above it: they are gone if somebody took them
  dynamics::write_checkpoint(below / name_of_checkpoint(steps, kind), state, build_info().revision);
  if (is_first) dynamics::sync_folder(folder);
}

bool is_by_clock(const fs::path& checkpoint) {
  return checkpoint.filename().string().ends_with(kClockEnd);
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

namespace {

/// @param is_gone  (name)
template <class IsGone>
void remove_those(const fs::path& folder, const IsGone& is_gone) {
  std::error_code ignored;
  for (const fs::path& file : checkpoints_of(folder))
    if (is_gone(file.filename().string())) fs::remove(file, ignored);
}

}  // namespace

void remove_clock_checkpoints(const fs::path& folder, std::optional<std::int64_t> but) {
  const std::string kept = but ? name_of_checkpoint(*but, CheckpointKind::by_clock) : "";
  remove_those(folder,
               [&](const std::string& name) { return name.ends_with(kClockEnd) && name != kept; });
}

void remove_checkpoints_after(const fs::path& folder, std::int64_t steps) {
  const std::string last = name_of_checkpoint(steps, CheckpointKind::by_clock);
  remove_those(folder, [&](const std::string& name) { return name > last; });
}

void remove_checkpoints(const fs::path& folder) {
  remove_those(folder, [](const std::string&) { return true; });
}

namespace {

/// What keeps a run from going on with its histories from a state; empty: nothing.
std::string problem_with_files(const fs::path& folder, const fs::path& checkpoint,
                               const geometry::StateTree& state) {
  WrittenFiles files;
  exchange_files(geometry::StateArchive::reader(state).group(kRunGroup), files);
  for (const auto& [name, size] : files.sizes) {
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(folder / name, error);
    if (error)
      return fmt::format("{}: {}, which the run had written then, is not there any more",
                         checkpoint.string(), name);
    if (bytes < size)
      return fmt::format("{}: {} has {} bytes, fewer than the {} that the run had written then",
                         checkpoint.string(), name, bytes, size);
  }
  return "";
}

/// Whether a state comes after the step in which a time lies.
bool is_after(const geometry::StateTree& state, double time) {
  double step = 0.0;  // s
  geometry::StateArchive::reader(state).group("step")("last_drift", step);
  return time_of(state) > time && time_of(state) - step >= time;
}

/// The last one of some files that can be read and is not after the step in which a time lies.
/// @param problem_with  (file, state), what is wrong with one that can be read; empty: nothing
/// @returns nothing if there is none, or all are later
/// @throws InputError naming what is wrong with those that cannot be read, if no other is left
template <class ProblemWith>
std::optional<FoundCheckpoint> last_of(std::vector<fs::path> files,
                                       const std::optional<double>& time,
                                       const ProblemWith& problem_with) {
  std::vector<std::string> damaged;
  for (; !files.empty(); files.pop_back()) {
    try {
      geometry::StateTree state = dynamics::read_checkpoint(files.back());
      if (time && is_after(state, *time)) {
        damaged.clear();  // those are later still
        continue;
      }
      if (std::string problem = problem_with(files.back(), state); !problem.empty()) {
        damaged.push_back(std::move(problem));
        continue;
      }
      return FoundCheckpoint{files.back(), std::move(state), std::move(damaged)};
    } catch (const dynamics::CheckpointError& error) {
      damaged.emplace_back(error.what());
    }
  }
  if (!damaged.empty()) throw InputError(fmt::format("{}", fmt::join(damaged, "\n")));
  return std::nullopt;
}

std::optional<FoundCheckpoint> last_of(std::vector<fs::path> files,
                                       const std::optional<double>& time) {
  return last_of(std::move(files), time,
                 [](const fs::path&, const geometry::StateTree&) { return std::string(); });
}

/// @throws InputError if there are none, or no folder
std::vector<fs::path> some_checkpoints_of(const fs::path& folder) {
  if (const std::string problem = problem_with_run_folder(folder); !problem.empty())
    throw InputError(problem);
  std::vector<fs::path> files = checkpoints_of(folder);
  if (files.empty())
    throw InputError(
        fmt::format("{}: has no checkpoints; a run writes them where its scenario says "
                    "checkpoint_interval in [output], when it is interrupted, and at its end",
                    folder.string()));
  return files;
}

/// @param first  checkpoint that can be read
[[noreturn]] void throw_too_early(const fs::path& folder, const fs::path& first, double time) {
  throw InputError(fmt::format(
      "{}: its first checkpoint comes after {:.6g} s, at {:.6g} s; ask for a later time",
      folder.string(), time, time_of(dynamics::read_checkpoint(first))));
}

}  // namespace

std::vector<std::string> warnings_about(const FoundCheckpoint& checkpoint) {
  std::vector<std::string> warnings = checkpoint.damaged;
  if (!warnings.empty())
    warnings.push_back(
        fmt::format("{}: is taken instead, an earlier checkpoint", checkpoint.file.string()));
  return warnings;
}

FoundCheckpoint last_checkpoint_with_files(const fs::path& folder) {
  // Nothing only if there are none: whatever is wrong with those that there are is thrown.
  return std::move(*last_of(some_checkpoints_of(folder), std::nullopt,
                            [&](const fs::path& file, const geometry::StateTree& state) {
                              return problem_with_files(folder, file, state);
                            }));
}

FoundCheckpoint last_checkpoint(const fs::path& folder, const std::optional<double>& time) {
  const std::vector<fs::path> files = some_checkpoints_of(folder);
  if (auto found = last_of(files, time)) return std::move(*found);
  throw_too_early(folder, files.front(), *time);
}

FoundCheckpoint checkpoint_before(const fs::path& folder, std::int64_t step,
                                  const std::optional<double>& time) {
  std::vector<fs::path> files = checkpoints_of(folder);
  std::erase_if(files, [&](const fs::path& file) {
    return file.filename() >= fs::path(name_of_checkpoint(step));
  });
  if (auto found = last_of(files, time)) return std::move(*found);
  if (time && !files.empty()) throw_too_early(folder, files.front(), *time);
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
