// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command.hpp"

namespace plekton::apps {

/// `plekton check` builds the scene of a scenario, and says what it is or what is wrong with it.
ProgramCommand add_check(CLI::App& app);

}  // namespace plekton::apps
