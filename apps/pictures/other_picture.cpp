// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/pictures/other_picture.hpp"

#include "apps/run/other_file.hpp"

#include <string_view>

namespace plekton::apps {
namespace {

bool is_png(std::string_view head) {
  return head.starts_with("\x89PNG\r\n\x1a\n");
}

bool is_plot(std::string_view head) {
  return head.starts_with("<?xml") && head.find("Produced by GNUPLOT") != std::string_view::npos;
}

}  // namespace

void refuse_other_picture(const std::filesystem::path& file) {
  if (file.extension() == ".svg")
    refuse_other_file(file, "plot (.svg) of plekton plot", is_plot);
  else
    refuse_other_file(file, "picture (.png)", is_png);
}

}  // namespace plekton::apps
