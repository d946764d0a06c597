// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command.hpp"

namespace plekton::apps {

/// `plekton new` writes a commented scenario to start from.
ProgramCommand add_new(CLI::App& app);

}  // namespace plekton::apps
