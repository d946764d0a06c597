// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/pictures/other_picture.hpp"

#include "apps/run/other_file.hpp"

namespace plekton::apps {

void refuse_other_picture(const std::filesystem::path& file) {
  if (file.extension() == ".svg")
    refuse_other_file(file, "plot (.svg) of plekton plot", is_plot);
  else
    refuse_other_file(file, "picture (.png)", is_png);
}

}  // namespace plekton::apps
