// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/temporary_folder.hpp"

#include <sched.h>
#include <sys/mount.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

namespace plekton::test {

/// Gives this process and those it starts mounts of their own, which end with them: nothing else on
/// the machine sees them. @returns whether it may have them
inline bool has_own_mounts() {
  static const bool has = ::unshare(CLONE_NEWNS) == 0 &&
                          ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
  return has;
}

/// A folder on a disk of its own with so much room, empty.
class SmallDisk {
 public:
  explicit SmallDisk(std::size_t bytes)
      : is_mounted_(has_own_mounts() && ::mount("tmpfs", folder_.path().c_str(), "tmpfs", 0,
                                                ("size=" + std::to_string(bytes)).c_str()) == 0) {}
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    if (is_mounted_) ::umount2(folder_.path().c_str(), MNT_DETACH);
  }

  bool is_mounted() const noexcept { return is_mounted_; }
  /// Gives it another size.
  bool resize(std::size_t bytes) const {
    return ::mount("tmpfs", folder_.path().c_str(), "tmpfs", MS_REMOUNT,
                   ("size=" + std::to_string(bytes)).c_str()) == 0;
  }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

 private:
  TemporaryFolder folder_;
  bool is_mounted_;
};

/// A folder that can be read alone within the scope, whoever asks.
class ReadOnlyFolder {
 public:
  explicit ReadOnlyFolder(const std::filesystem::path& folder) : folder_(folder) {
    if (!has_own_mounts() ||
        ::mount(folder.c_str(), folder.c_str(), nullptr, MS_BIND, nullptr) != 0)
      return;
    is_mounted_ = true;
    // Busy as long as a file in it is open for writing.
    for (int i = 0; i < 1000 && !is_read_only_; ++i) {
      is_read_only_ =
          ::mount(nullptr, folder.c_str(), nullptr, MS_REMOUNT | MS_BIND | MS_RDONLY, nullptr) == 0;
      if (!is_read_only_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  ReadOnlyFolder(const ReadOnlyFolder&) = delete;
  ReadOnlyFolder& operator=(const ReadOnlyFolder&) = delete;
  ~ReadOnlyFolder() {
    if (is_mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
  }

  bool is_read_only() const noexcept { return is_read_only_; }

 private:
  std::filesystem::path folder_;
  bool is_mounted_ = false;
  bool is_read_only_ = false;
};

}  // namespace plekton::test
