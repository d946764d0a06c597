// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/config_tree.hpp"
#include "apps/scenario/key_recorder.hpp"
#include "apps/scenario/scenario.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace plekton::apps {

/// Reads a scenario file, or standard input (kStandardInput); mesh files are relative to its
/// folder, of standard input to the current one.
/// @param overrides  "path=value" each, applied before anything is checked (overrides.hpp).
/// @throws InputError listing every problem of the file, each with its place, what was found, what
///         was expected, and a suggestion: keys that are unknown or missing, wrong kinds and units,
///         values out of range, materials and mesh files that do not exist, sieve tables that do
///         not rise.
Scenario read_scenario(const std::filesystem::path& path,
                       std::span<const std::string> overrides = {});

/// The same from memory.
/// @param path  What messages call it; mesh files are relative to its folder.
Scenario parse_scenario(std::string_view text, const std::filesystem::path& path,
                        std::span<const std::string> overrides = {});

/// The same from tables that were made and not read; places of all that is in them are those of
/// the path. The text of the scenario is what to_toml() makes of the tables.
Scenario scenario_from(Table table, const std::filesystem::path& path,
                       std::span<const std::string> overrides = {});

/// Tells a recorder of every key that the reader asks for.
void record_keys(KeyRecorder& recorder);

}  // namespace plekton::apps
