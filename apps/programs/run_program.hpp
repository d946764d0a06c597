// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plekton::apps {

/// Runs a program to its end. What it says is shown only if it fails.
/// @param arguments  The path of the program and what it is told.
/// @param log  File for what it says.
/// @throws InputError if it fails, with the last error it has told, or its last line
void run_to_end(const std::vector<std::string>& arguments, const std::filesystem::path& log);

}  // namespace plekton::apps
