// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace plekton::apps {

/// What `plekton plot` was asked for.
struct PlotArguments {
  std::filesystem::path run;         ///< folder of a run
  std::vector<std::string> columns;  ///< none: all that say something
  std::string x;                     ///< column on the horizontal axis; empty: the time
  std::filesystem::path out;         ///< .svg or .png; empty: plot.svg and plot.png in the folder
};

/// Draws the histories of a run. @throws InputError, ViewError, dynamics::OutputError
void plot_run(const PlotArguments& arguments, std::ostream& out);

}  // namespace plekton::apps
