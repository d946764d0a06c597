// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/takeover/yade_scene.hpp"

#include <filesystem>
#include <optional>

namespace plekton::apps::yade {

/// Runs a script in YADE, without its windows, to an iteration, and reads what is there then.
/// @param iteration  nothing: where the script ends
/// @throws InputError if YADE is not installed, or the script fails or goes on beyond the iteration,
///         or without an end
Scene run_to(const std::filesystem::path& script, std::optional<long> iteration);

}  // namespace plekton::apps::yade
