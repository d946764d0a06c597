// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace plekton::apps {

/// What a checkpoint holds, as text: of which run and when, how much of what, and its arrays.
/// @param path  of a checkpoint, or of the folder of a run, whose last one is meant
/// @throws dynamics::CheckpointError, geometry::StateMismatch; InputError of a folder without one
std::string text_of_checkpoint(const std::filesystem::path& path);

}  // namespace plekton::apps
