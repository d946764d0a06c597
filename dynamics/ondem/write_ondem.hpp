// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/ondem/ondem_scene.hpp"

#include <filesystem>
#include <string>

namespace plekton::dynamics {

/// A scene as the bytes of a VTKHDF file; the same scene makes the same bytes.
/// @throws std::invalid_argument for blocks whose names cannot be those of groups, or of which one
///         is there twice
std::string ondem_file_of(const OndemScene& scene);

/// @throws OutputError; what was there of that name is replaced at once, or not at all
void write_ondem(const std::filesystem::path& file, const OndemScene& scene);

}  // namespace plekton::dynamics
