// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace plekton::geometry {

/// Where a file is written before it gets its name: `NAME.part`, beside it.
std::filesystem::path part_of(const std::filesystem::path& path);

/// Whether a device, a pipe or a socket has this name, or what a link of it leads to: giving the name
/// to a file would take it away from everybody.
bool is_no_file(const std::filesystem::path& path) noexcept;

/// Creates a file and opens it for writing at its end. Nothing that somebody put there before is
/// written into, so that in a folder that others may write to no link leads elsewhere. A regular
/// file of that name, as a stopped writer leaves it, is removed first.
/// @returns A descriptor; -1 with errno for an error: ELOOP where a link has the name, EISDIR where
/// a folder, EEXIST where anything else that is no regular file, or what open() gives.
int create_new_file(const std::filesystem::path& path) noexcept;

}  // namespace plekton::geometry
