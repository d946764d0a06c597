// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command.hpp"

namespace plekton::apps {

/// `plekton import` reads and repairs a mesh, and reports on it.
ProgramCommand add_import(CLI::App& app);

}  // namespace plekton::apps
