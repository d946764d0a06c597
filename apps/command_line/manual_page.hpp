// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command_table.hpp"

#include <span>
#include <string>
#include <string_view>

namespace plekton::apps {

/// plekton(1) in the language of man(7).
/// @param date  as in "2026-11-23"
std::string manual_page(std::span<const CommandEntry> commands, std::string_view date);

}  // namespace plekton::apps
