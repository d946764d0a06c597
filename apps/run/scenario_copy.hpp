// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace plekton::apps {

/// The copy of the scenario in the folder of a run.
inline constexpr std::string_view kScenarioCopy = "scenario-as-run.toml";

/// The text of a scenario as it was read, followed by comments that say where it comes from and
/// what --set and --threads replaced in it. Lines keep their numbers.
std::string copy_of(const Scenario& scenario);

/// Writes that into a folder, complete or not at all. A scenario that is this very file stays as it
/// is. @throws dynamics::OutputError
void write_scenario_copy(const std::filesystem::path& folder, const Scenario& scenario);

/// Of a run that goes on: does that where the copy says that other values were replaced, but for
/// threads. @throws dynamics::OutputError
void update_scenario_copy(const std::filesystem::path& folder, const Scenario& scenario);

}  // namespace plekton::apps
