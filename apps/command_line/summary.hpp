// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/run.hpp"

#include <string>

namespace plekton::apps {

/// What was built, for people: membranes, grains, masses, time step, warnings.
/// @param scenario  with all stages, of which this may be one
std::string summary_of(const Scenario& scenario, const PreparedRun& prepared);

/// The critical step that power iteration found.
std::string summary_of(const dynamics::ExactStep& step);

/// How a run ended, for people.
std::string summary_of(const RunReport& report);

}  // namespace plekton::apps
