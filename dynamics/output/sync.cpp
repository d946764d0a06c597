// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/sync.hpp"

#include "dynamics/output/file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace plekton::dynamics {
namespace {

int sync_error(const std::filesystem::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  if (descriptor < 0) return errno;
  int reason = EINTR;
  while (reason == EINTR) reason = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  // No file that is kept, or a file system that keeps none.
  return reason == EINVAL || reason == ENOTSUP ? 0 : reason;
}

void sync(const std::filesystem::path& path, int flags) {
  if (goes_nowhere(path)) return;
  if (const int reason = sync_error(path, flags); reason != 0)
    throw OutputError(path, "make sure that it is on the disk", reason);
}

}  // namespace

void sync_file(const std::filesystem::path& file) {
  sync(file, O_NOFOLLOW);
}

void sync_folder(const std::filesystem::path& folder) {
  sync(folder.empty() ? std::filesystem::path(".") : folder, O_DIRECTORY);
}

}  // namespace plekton::dynamics
