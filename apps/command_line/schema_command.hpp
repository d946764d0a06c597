// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command.hpp"

namespace plekton::apps {

/// `plekton schema` prints a JSON Schema of scenarios.
ProgramCommand add_schema(CLI::App& app);

}  // namespace plekton::apps
