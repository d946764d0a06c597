// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace plekton::apps {

/// Makes a folder that takes files, with the folders above it. @throws dynamics::OutputError
void make_output_folder(const std::filesystem::path& folder);

}  // namespace plekton::apps
