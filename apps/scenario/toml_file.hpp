// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/config_tree.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace plekton::apps {

/// Reads a TOML file. Places name it as the path is written.
/// @throws InputError if it cannot be read or is not TOML, with the place where it stops being so.
Table read_toml_file(const std::filesystem::path& path);

/// The same from memory.
/// @param source  What places call it.
Table parse_toml(std::string_view text, const std::string& source);

/// A single value written as in TOML; anything that is not is a text, so that quotes may be left
/// out ("2 s").
/// @param place  Where the value is said to be.
Value parse_toml_value(std::string_view text, const Place& place);

}  // namespace plekton::apps
