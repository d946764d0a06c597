// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/pictures/plot.hpp"

#include <string>
#include <vector>

namespace plekton::apps {

/// The bytes of a picture that gnuplot draws.
/// @throws InputError if gnuplot is not installed or cannot draw that kind
std::string drawn_plot(const std::vector<PlotPanel>& panels, const std::string& title,
                       PictureKind kind);

}  // namespace plekton::apps
