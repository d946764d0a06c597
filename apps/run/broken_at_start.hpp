// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scene/build_scene.hpp"
#include "dynamics/simulation.hpp"

#include <string>
#include <vector>

namespace plekton::apps {

/// Of each membrane with bars, beams or facets that are broken before the first step.
std::vector<std::string> warnings_about_breaks(const BuiltScene& built,
                                               const dynamics::Simulation& simulation);

}  // namespace plekton::apps
