// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command.hpp"

namespace plekton::apps {

/// `plekton run` runs a scenario, on all ranks that were started together, or goes on with a run.
ProgramCommand add_run(CLI::App& app);

}  // namespace plekton::apps
