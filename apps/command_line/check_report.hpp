// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/run.hpp"
#include "apps/scenario/scenario.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace plekton::apps {

/// What `plekton check` prints, as a JSON object with units in its keys: bodies with their boxes,
/// time step with what limits it, bonds, overlaps, warnings, and an estimate of what a run takes,
/// for which the simulation makes some steps; no problems.
nlohmann::ordered_json check_report(const Scenario& scenario, PreparedRun& prepared);

/// The same of a scenario that cannot be run: its problems alone.
/// @param message  of the error: a line for each problem; one that begins with a blank goes on with
/// the problem before it
nlohmann::ordered_json check_report(const std::string& message);

}  // namespace plekton::apps
