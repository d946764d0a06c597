// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command.hpp"

#include <filesystem>
#include <optional>
#include <ostream>

namespace plekton::apps {

/// What `plekton view` was asked for.
struct ViewArguments {
  std::filesystem::path run;                 ///< folder of a run
  std::optional<std::filesystem::path> out;  ///< view.html in that folder if not given
  double limit = 100.0;                      ///< MB of data
  std::optional<int> port;                   ///< serve there; 0: any that is free
};

/// Writes a page that shows a run, or serves it until it is interrupted, and says where.
/// @throws ViewError, dynamics::OutputError
void view_run(const ViewArguments& arguments, std::ostream& out);

/// `plekton view` writes or serves that page.
ProgramCommand add_view(CLI::App& app);

}  // namespace plekton::apps
