// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command_table.hpp"

#include <span>
#include <string>

/// Pages of the reference in Markdown, each from the table by which the program itself works.
namespace plekton::apps {

/// Keys of a scenario: name, type, unit, default, range and meaning.
std::string keys_page();
/// Contact laws with their parameters.
std::string laws_page();
/// Columns and arrays of what a run writes.
std::string outputs_page();
/// Commands with their options.
std::string commands_page(std::span<const CommandEntry> commands);

}  // namespace plekton::apps
