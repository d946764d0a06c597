// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <iosfwd>

namespace plekton::apps {

/// Says what a checkpoint holds: of which run and when, how much of what, and its arrays.
/// @param path      of a checkpoint, or of the folder of a run, whose last one is meant
/// @param problems  told of later checkpoints that are damaged
/// @throws dynamics::CheckpointError, geometry::StateMismatch; InputError of a folder without one
void inspect_checkpoint(const std::filesystem::path& path, std::ostream& out,
                        std::ostream& problems);

}  // namespace plekton::apps
