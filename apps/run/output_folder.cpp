// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/output_folder.hpp"

#include "dynamics/output/file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace plekton::apps {

void make_output_folder(const std::filesystem::path& folder) {
  const std::filesystem::path parent =
      (folder.has_filename() ? folder : folder.parent_path()).parent_path();
  if (!parent.empty()) {
    std::error_code error;
    std::filesystem::create_directories(parent, error);
    if (error) throw dynamics::OutputError(parent, "create the folder", error.value());
  }
  dynamics::ensure_output_folder(folder);
}

OutputFolderLock::OutputFolderLock(const std::filesystem::path& folder)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK)
    return;
  ::close(descriptor_);
  throw dynamics::OutputError(
      folder, "another run writes to this folder; wait for its end or choose another with --out");
}

OutputFolderLock::~OutputFolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace plekton::apps
