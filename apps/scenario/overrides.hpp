// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/config_tree.hpp"

#include <span>
#include <string>

namespace plekton::apps {

/// Replaces or adds values in a configuration, in the order given; afterwards their place is the
/// option itself.
/// @param options  Each "path=value", such as "simulation.duration=2 s", "grains.gravel.count=50"
///        or "planes.0.point=[0, 0, 1]". The path goes through tables by key and through lists by
///        the name of an entry or its number from 0. Tables that are missing are made. The value is
///        TOML; quotes may be left out.
/// @throws InputError naming every option that has no path or value, or whose path leads nowhere.
void apply_overrides(Table& root, std::span<const std::string> options);

}  // namespace plekton::apps
