// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/checkpoints.hpp"
#include "apps/run/scenario_copy.hpp"
#include "apps/run/written_files.hpp"

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace plekton::apps {

/// Makes a folder that takes files, with the folders above it. @throws dynamics::OutputError
void make_output_folder(const std::filesystem::path& folder);

/// What a run may write into its folder, beside its frames. The folder of measures is one only with
/// measures in it.
inline constexpr std::array<std::string_view, 14> kResultFiles = {
    "run.json",        "energy.csv", "reactions.csv", "pressures.csv", kRigidBodiesFile,
    "ties.csv",        "planes.csv", "contacts.csv",  kMeasuresFolder, kScenarioCopy,
    kCheckpointFolder, "grains.pvd", "membranes.pvd", "contacts.pvd"};

/// Whether there is a file of a name, or measures.
/// @param file  one of kResultFiles, or what else is made
bool has_results(const std::filesystem::path& folder, std::string_view file);

/// Whether a run has written into a folder.
bool has_any_result(const std::filesystem::path& folder);

/// Refuses a folder that holds a file of these names.
/// @param maker  What made them, for the message: "run" or "import".
/// @throws dynamics::OutputError naming the first that is there
void refuse_results(const std::filesystem::path& folder, std::string_view maker,
                    std::span<const std::string_view> files);

/// What keeps a path from being the folder of a run; empty: it is a folder.
std::string problem_with_run_folder(const std::filesystem::path& folder);

/// Removes what a run that was killed has left of files that it was writing, and nothing else that
/// is called NAME.part. The folder has to be locked.
void remove_parts(const std::filesystem::path& folder);

/// Refuses a folder that another run writes to, and, unless it is to be overwritten, one that holds
/// results of an earlier run. Nothing is created.
/// @throws dynamics::OutputError
void check_output_folder(const std::filesystem::path& folder, bool overwrite);

/// Keeps a folder for one run: a second run into it would mix its files with those of the first.
/// The lock ends with the process, however that ends.
class OutputFolderLock {
 public:
  /// @throws dynamics::OutputError if another run holds the folder, or it is there and cannot be
  /// opened
  explicit OutputFolderLock(const std::filesystem::path& folder);
  OutputFolderLock(const OutputFolderLock&) = delete;
  OutputFolderLock& operator=(const OutputFolderLock&) = delete;
  ~OutputFolderLock();

  /// That nothing guards the folder, as on file systems without locks; empty: it is guarded, or not
  /// there.
  const std::string& warning() const noexcept { return warning_; }

 private:
  int descriptor_;
  std::string warning_;
};

}  // namespace plekton::apps
