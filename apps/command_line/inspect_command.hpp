// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <iosfwd>

namespace plekton::apps {

/// What `plekton inspect` was asked for.
struct InspectArguments {
  std::filesystem::path checkpoint;  ///< or the folder of a run, whose last one is meant
  bool all = false;                  ///< with a line for each array
};

/// Says what a checkpoint holds: of which run and when, and how much of what.
/// @param problems  told of later checkpoints that are damaged
/// @throws dynamics::CheckpointError, geometry::StateMismatch; InputError of a folder without one
void inspect_checkpoint(const InspectArguments& arguments, std::ostream& out,
                        std::ostream& problems);

}  // namespace plekton::apps
