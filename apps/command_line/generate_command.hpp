// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command.hpp"

namespace plekton::apps {

/// `plekton generate`, which is not in the help, writes parts of the documentation.
/// @param app  whose commands they name, also those that are added later
ProgramCommand add_generate(CLI::App& app);

}  // namespace plekton::apps
