// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/regular_file.hpp"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <limits>
#include <system_error>

namespace plekton::geometry {
namespace {

namespace fs = std::filesystem;

/// Closes a descriptor at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const noexcept { return number_; }

 private:
  int number_;
};

/// Whether the kernel makes the file up when it is read. It then calls itself regular.
bool is_made_up(int descriptor) {
  constexpr std::array<long, 11> kMadeUp = {
      PROC_SUPER_MAGIC, SYSFS_MAGIC,        DEBUGFS_MAGIC,       TRACEFS_MAGIC,
      SECURITYFS_MAGIC, CGROUP_SUPER_MAGIC, CGROUP2_SUPER_MAGIC, BPF_FS_MAGIC,
      PSTOREFS_MAGIC,   EFIVARFS_MAGIC,     SELINUX_MAGIC};
  struct statfs system {};
  if (::fstatfs(descriptor, &system) != 0) return false;
  return std::find(kMadeUp.begin(), kMadeUp.end(), static_cast<long>(system.f_type)) !=
         kMadeUp.end();
}

bool is_regular(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && !is_made_up(descriptor);
}

/// bytes
std::uintmax_t size_of(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 ? static_cast<std::uintmax_t>(status.st_size) : 0;
}

/// bytes, of the machine
std::uintmax_t memory() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), size = ::sysconf(_SC_PAGESIZE);
  return pages > 0 && size > 0
             ? static_cast<std::uintmax_t>(pages) * static_cast<std::uintmax_t>(size)
             : std::numeric_limits<std::uintmax_t>::max();
}

/// The bytes of an open file, as many as its size; errno says why there are fewer.
std::string bytes_of(int descriptor) {
  std::string bytes(size_of(descriptor), '\0');
  std::size_t count = 0;
  errno = 0;
  while (count < bytes.size()) {
    const ssize_t read = ::read(descriptor, bytes.data() + count, bytes.size() - count);
    if (read < 0 && errno == EINTR) continue;
    if (read <= 0) break;
    count += static_cast<std::size_t>(read);
    errno = 0;
  }
  bytes.resize(count);
  return bytes;
}

}  // namespace

std::string read_regular_file(const fs::path& path, std::string_view expected) {
  const auto fail = [&](std::string problem) -> UnreadableFile {
    return UnreadableFile(path.string() + ": " + problem);
  };
  const std::string no_file = "not a file on a disk; expected " + std::string(expected);
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (!fs::exists(status) && status.type() != fs::file_type::none)
    throw fail("no such file; check the path (it counts from the current folder)");
  // Asked before it is opened, because opening a device may do something.
  if (fs::exists(status) && !fs::is_regular_file(status)) throw fail(no_file);
  // Not blocking, should a pipe have taken its place.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (file.number() < 0) throw fail("cannot be read; check its permissions");
  if (!is_regular(file.number())) throw fail(no_file);
  if (const std::uintmax_t size = size_of(file.number()); size > memory())
    throw fail("has " + std::to_string(size) + " bytes, more than this machine has memory (" +
               std::to_string(memory()) + "); expected " + std::string(expected));
  std::string bytes = bytes_of(file.number());
  if (errno != 0) throw fail("cannot be read; check the disk and its connection");
  return bytes;
}

}  // namespace plekton::geometry
