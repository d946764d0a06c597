// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/takeover/yade_scene.hpp"

#include <filesystem>

namespace plekton::apps::yade {

/// Runs a script in YADE, without its windows, to an iteration, and reads what is there then.
/// @throws InputError if YADE is not installed, or the script fails or goes on beyond the iteration
Scene run_to(const std::filesystem::path& script, long iteration);

}  // namespace plekton::apps::yade
