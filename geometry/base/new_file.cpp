// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/new_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace plekton::geometry {
namespace {

int open_exclusively(const char* path) noexcept {
  constexpr mode_t kReadWriteForAllButUmask = 0666;
  // At the end, so that a write follows the cut after a failed one.
  return ::open(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_APPEND | O_CLOEXEC,
                kReadWriteForAllButUmask);
}

/// errno for what has a name that is wanted; 0 for what may be removed.
int reason_against(const char* path) noexcept {
  struct stat status {};
  if (::lstat(path, &status) != 0) return errno == ENOENT ? 0 : errno;
  if (S_ISREG(status.st_mode)) return 0;
  if (S_ISLNK(status.st_mode)) return ELOOP;
  return S_ISDIR(status.st_mode) ? EISDIR : EEXIST;
}

}  // namespace

std::filesystem::path part_of(const std::filesystem::path& path) {
  std::filesystem::path part = path;
  part += ".part";
  return part;
}

bool is_no_file(const std::filesystem::path& path) noexcept {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  return std::filesystem::is_other(status);
}

int create_new_file(const std::filesystem::path& path) noexcept {
  const int descriptor = open_exclusively(path.c_str());
  if (descriptor >= 0 || errno != EEXIST) return descriptor;
  const int reason = reason_against(path.c_str());
  if (reason != 0) {
    errno = reason;
    return -1;
  }
  // What takes the name between these two calls is met by O_EXCL again.
  ::unlink(path.c_str());
  return open_exclusively(path.c_str());
}

}  // namespace plekton::geometry
