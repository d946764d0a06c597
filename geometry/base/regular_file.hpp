// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace plekton::geometry {

/// A file that cannot be read. The message names it, what is wrong, and what to do.
struct UnreadableFile : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// All bytes of a file on a disk. Folders, pipes, devices and what the kernel makes up when it is
/// read (/proc, /sys) are refused before a byte is read, because these may block for ever or have
/// no end. Memory is bounded by the size that the file has at the call, and none is taken for one
/// that is larger than the memory of the machine.
/// @param expected  What the file should be, as in "a scenario (.toml)".
/// @throws UnreadableFile
std::string read_regular_file(const std::filesystem::path& path, std::string_view expected);

}  // namespace plekton::geometry
