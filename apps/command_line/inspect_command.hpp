// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command.hpp"

namespace plekton::apps {

/// `plekton inspect` says what a checkpoint of a run holds.
ProgramCommand add_inspect(CLI::App& app);

}  // namespace plekton::apps
