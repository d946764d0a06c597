// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command.hpp"

namespace plekton::apps {

/// `plekton study` makes many runs of a scenario, and a table of their results.
ProgramCommand add_study(CLI::App& app);

}  // namespace plekton::apps
