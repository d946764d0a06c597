// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/config_tree.hpp"

#include <string>
#include <vector>

namespace plekton::apps {

/// What `--set` may replace or add in a scenario, as in "simulation.duration" and
/// "grains.gravel.count": every key of the tables that it has. Entries of lists are called by their
/// name where it is a plain word, else by their number.
std::vector<std::string> set_paths(const Table& scenario);

}  // namespace plekton::apps
