// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace plekton::apps {

/// Makes a folder that takes files, with the folders above it. @throws dynamics::OutputError
void make_output_folder(const std::filesystem::path& folder);

/// Keeps a folder for one run: a second run into it would mix its files with those of the first.
/// The lock ends with the process, however that ends. File systems without locks are not guarded.
class OutputFolderLock {
 public:
  /// @throws dynamics::OutputError if another run holds the folder
  explicit OutputFolderLock(const std::filesystem::path& folder);
  OutputFolderLock(const OutputFolderLock&) = delete;
  OutputFolderLock& operator=(const OutputFolderLock&) = delete;
  ~OutputFolderLock();

 private:
  int descriptor_;
};

}  // namespace plekton::apps
