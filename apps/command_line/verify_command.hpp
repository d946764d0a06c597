// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command.hpp"

namespace plekton::apps {

/// `plekton verify` computes a part of a run again, and compares bits.
ProgramCommand add_verify(CLI::App& app);

}  // namespace plekton::apps
