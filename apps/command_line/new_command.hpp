// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string_view>

namespace plekton::apps {

/// A commented scenario to start from: grains fall on a sheet that hangs at its rim.
std::string_view starting_scenario() noexcept;

/// Writes it to a file that is not there yet, and says what to do with it.
/// @throws InputError
void write_starting_scenario(const std::filesystem::path& file, std::ostream& out);

}  // namespace plekton::apps
