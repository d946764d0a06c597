// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/run.hpp"

#include <string>

namespace plekton::apps {

/// What was built, for people: membranes, grains, masses, time step, warnings.
std::string summary_of(const PreparedRun& prepared);

/// The critical step that power iteration found.
std::string summary_of(const dynamics::ExactStep& step);

/// How a run ended, for people.
std::string summary_of(const RunReport& report);

}  // namespace plekton::apps
