// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command_table.hpp"

#include <span>
#include <string>

namespace plekton::apps {

/// A script for bash that completes commands, options, files, names of examples, and paths of --set
/// from the scenario on the line.
std::string bash_completion(std::span<const CommandEntry> commands);

}  // namespace plekton::apps
