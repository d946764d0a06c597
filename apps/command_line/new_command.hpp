// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <iosfwd>

namespace plekton::apps {

/// Writes a commented scenario to start from to a file that is not there yet, and says what to do
/// with it: grains fall on a sheet that hangs at its rim.
/// @throws InputError
void write_starting_scenario(const std::filesystem::path& file, std::ostream& out);

}  // namespace plekton::apps
