// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command.hpp"

namespace plekton::apps {

/// `plekton render` draws a frame of a run.
ProgramCommand add_render(CLI::App& app);

}  // namespace plekton::apps
