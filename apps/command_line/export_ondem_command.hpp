// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command.hpp"

namespace plekton::apps {

/// `plekton export-ondem` writes what a checkpoint of a run holds as a file of the ON-DEM network.
ProgramCommand add_export_ondem(CLI::App& app);

}  // namespace plekton::apps
