// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

/// What is to be there after a power cut too. Without it the system may keep what is written in
/// memory for half a minute, and give a file its name before it has its bytes.
namespace plekton::dynamics {

/// Waits until all that is written to a file is on the disk; nothing below kNowhere, and where the
/// file system has no such call. @throws OutputError
void sync_file(const std::filesystem::path& file);

/// The same of the names in a folder: of files that are new there or have been renamed.
/// @param folder  empty: the one the process works in
/// @throws OutputError
void sync_folder(const std::filesystem::path& folder);

}  // namespace plekton::dynamics
