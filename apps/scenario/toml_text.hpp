// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/config_tree.hpp"

#include <string>

namespace plekton::apps {

/// Tables as TOML: [tables] and [[lists of tables]] at the root, everything in them on one line.
/// parse_toml() makes the same tables of it, but for the places; numbers keep every bit.
std::string to_toml(const Table& table);

}  // namespace plekton::apps
