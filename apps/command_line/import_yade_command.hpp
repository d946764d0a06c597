// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command.hpp"

namespace plekton::apps {

/// `plekton import-yade` runs a script of YADE and writes what is there as a scenario.
ProgramCommand add_import_yade(CLI::App& app);

}  // namespace plekton::apps
