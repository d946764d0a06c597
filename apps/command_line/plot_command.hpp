// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command.hpp"

namespace plekton::apps {

/// `plekton plot` draws the histories of a run.
ProgramCommand add_plot(CLI::App& app);

}  // namespace plekton::apps
