// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/run_aloud.hpp"

#include <filesystem>
#include <string>

namespace plekton::apps {

/// Goes on with the run in the folder `resume`, or computes a part of it again.
/// @returns an ExitCode
/// @throws InputError, and as run()
int run_resumed(const RunArguments& arguments);

/// Refuses to write results over those of the run that they begin from.
/// @param option  that names its folder
/// @throws InputError
void require_kept(const std::string& option, const std::filesystem::path& folder,
                  const std::filesystem::path& out);

}  // namespace plekton::apps
