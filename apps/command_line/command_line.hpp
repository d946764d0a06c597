// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/exit_code.hpp"

namespace plekton::apps {

/// The program: reads the command line, does what it says, prints to standard output, and problems
/// to standard error.
/// @returns an ExitCode
int run_program(int argc, const char* const* argv);

}  // namespace plekton::apps
