// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

namespace plekton::apps {

/// An empty folder for what is needed only for a while, gone with all that is in it at the end.
class ScratchFolder {
 public:
  /// @param purpose  For its name, as in "verify".
  /// @throws InputError if there can be none
  explicit ScratchFolder(std::string_view purpose);
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();

  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace plekton::apps
