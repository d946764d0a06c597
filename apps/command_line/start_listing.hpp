// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/run.hpp"

#include <string>

namespace plekton::apps {

/// How a scene begins, in lines: the boxes around its bodies, the bonds that hold, and who overlaps
/// whom, with the deepest places.
std::string listing_of_start(const Scenario& scenario, const PreparedRun& prepared);

}  // namespace plekton::apps
