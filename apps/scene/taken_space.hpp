// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"
#include "apps/scene/build_scene.hpp"

#include <span>
#include <string>

namespace plekton::apps {

/// Which plane or membrane takes up the most of a space in which grains found no room, if it is at
/// least half of where the centre of the largest grain could be: behind the plane, or within the
/// thickness. By a thousand places at random, always the same.
/// @param settings  of grains in a box or cylinder
/// @param built     with its planes, membranes and rigid bodies
/// @param x         m, where nodes are
/// @returns what to do about it, after "; ", or nothing
std::string what_takes_up(const GrainSettings& settings, const Scenario& scenario,
                          const BuiltScene& built, std::span<const Vec3> x);

}  // namespace plekton::apps
