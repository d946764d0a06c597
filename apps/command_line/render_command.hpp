// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <ostream>
#include <string>

namespace plekton::apps {

/// What `plekton render` was asked for.
struct RenderArguments {
  std::filesystem::path run;  ///< folder of a run
  std::string at;             ///< a time; empty: that of the last frame
  std::filesystem::path out;  ///< .png; empty: frame.png in the folder
};

/// Draws a frame of a run. @throws InputError, ViewError, dynamics::OutputError
void render_run(const RenderArguments& arguments, std::ostream& out);

}  // namespace plekton::apps
