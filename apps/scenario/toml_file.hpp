// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/config_tree.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace plekton::apps {

/// What stands for standard input on the command line, and what messages call that.
inline constexpr std::string_view kStandardInput = "-";
inline constexpr std::string_view kStandardInputName = "standard input";

/// The text of a file, or of standard input.
/// @throws InputError if it cannot be read, or is longer than any scenario
std::string read_toml_text(const std::filesystem::path& path);

/// Reads TOML.
/// @param source  What places call it.
/// @throws InputError if it is not TOML, with the place where it stops being so.
Table parse_toml(std::string_view text, const std::string& source);

/// A single value written as in TOML; anything that is not is a text, so that quotes may be left
/// out ("2 s").
/// @param place  Where the value is said to be.
Value parse_toml_value(std::string_view text, const Place& place);

}  // namespace plekton::apps
