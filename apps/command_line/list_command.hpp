// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command.hpp"

namespace plekton::apps {

/// `plekton list` prints what a scenario can name, with parameters, units and defaults.
ProgramCommand add_list(CLI::App& app);

}  // namespace plekton::apps
