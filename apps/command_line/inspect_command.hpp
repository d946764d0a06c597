// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace plekton::apps {

/// What a checkpoint holds, as text: of which run and when, how much of what, and its arrays.
/// @throws dynamics::CheckpointError, geometry::StateMismatch
std::string text_of_checkpoint(const std::filesystem::path& file);

}  // namespace plekton::apps
