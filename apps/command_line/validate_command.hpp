// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command.hpp"

namespace plekton::apps {

/// `plekton validate` compares with theory what this program comes to.
ProgramCommand add_validate(CLI::App& app);

}  // namespace plekton::apps
