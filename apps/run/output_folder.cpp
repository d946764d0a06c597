// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/output_folder.hpp"

#include "apps/run/frames.hpp"
#include "apps/run/measures.hpp"
#include "dynamics/output/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

namespace plekton::apps {

namespace fs = std::filesystem;

namespace {

/// Those of files whose name is a result's.
template <class IsResult>
void remove_parts_in(const fs::path& folder, const IsResult& is_result) {
  std::vector<fs::path> parts;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const fs::path& path = entry.path();
    if (path.extension() == ".part" && is_result(path.stem().string()) &&
        fs::is_regular_file(entry.symlink_status(ignored)))
      parts.push_back(path);
  }
  for (const fs::path& part : parts) fs::remove(part, ignored);
}

}  // namespace

void make_output_folder(const fs::path& folder) {
  if (dynamics::goes_nowhere(folder)) return;
  const fs::path parent = (folder.has_filename() ? folder : folder.parent_path()).parent_path();
  if (!parent.empty()) {
    std::error_code error;
    fs::create_directories(parent, error);
    if (error) throw dynamics::OutputError(parent, "create the folder", error.value());
  }
  dynamics::ensure_output_folder(folder);
}

bool has_results(const fs::path& folder, std::string_view file) {
  if (file == kMeasuresFolder) return !measures_in(folder).empty();
  std::error_code ignored;
  // Also a link to nowhere is somebody's.
  return fs::exists(fs::symlink_status(folder / file, ignored));
}

bool has_any_result(const fs::path& folder) {
  return std::ranges::any_of(kResultFiles,
                             [&](std::string_view file) { return has_results(folder, file); });
}

void refuse_results(const fs::path& folder, std::string_view maker,
                    std::span<const std::string_view> files) {
  for (const std::string_view file : files) {
    if (!has_results(folder, file)) continue;
    throw dynamics::OutputError(
        folder, fmt::format("holds results of an earlier {} ({}); choose another folder with "
                            "--out, or replace them with --overwrite",
                            maker, file));
  }
}

std::string problem_with_run_folder(const fs::path& folder) {
  std::error_code ignored;
  if (fs::is_directory(folder, ignored)) return "";
  return folder.string() + (fs::exists(folder, ignored)
                                ? ": is no folder; name the folder of a run"
                                : ": there is no such folder; name the folder of a run, as plekton "
                                  "run says it at its end");
}

void remove_parts(const fs::path& folder) {
  const auto is_result = [](std::string_view name) {
    return std::ranges::find(kResultFiles, name) != kResultFiles.end();
  };
  remove_parts_in(folder, is_result);
  remove_parts_in(folder / "frames", is_frame);
  remove_parts_in(folder / kCheckpointFolder, is_checkpoint);
}

void check_output_folder(const fs::path& folder, bool overwrite) {
  const OutputFolderLock lock(folder);
  if (!overwrite) refuse_results(folder, "run", kResultFiles);
}

OutputFolderLock::OutputFolderLock(const fs::path& folder)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0) {
    // No folder yet, or none at all: whoever makes it says so.
    if (errno == ENOENT || errno == ENOTDIR) return;
    throw dynamics::OutputError(folder, "open the folder to keep other runs out of it", errno);
  }
  int reason = EINTR;
  while (reason == EINTR) reason = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
  if (reason == EWOULDBLOCK) {
    ::close(descriptor_);
    throw dynamics::OutputError(folder,
                                "another run writes to this folder; wait for its end or choose "
                                "another with --out");
  }
  if (reason != 0)
    warning_ = fmt::format(
        "{}: cannot be locked ({}), so that nothing keeps a second run out of it: see that there "
        "is none",
        folder.string(), std::generic_category().message(reason));
}

OutputFolderLock::~OutputFolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace plekton::apps
