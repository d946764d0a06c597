// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/validation/figure.hpp"

#include <string_view>
#include <utility>
#include <vector>

namespace plekton::apps {

/// A curve that another program gave for the same case: numbers of apps/validation/recorded, which says there where they are from. They
/// are shown beside ours, and decide nothing.
/// @param name  of the file, without .csv
/// @throws std::logic_error where there is no such file
Curve recorded_curve(std::string_view name);

/// The files, by name, as texts in the program.
std::string_view recorded_text(std::string_view name);

/// A curve of a text: lines with # are left out, then heads, then rows of two numbers.
std::pair<std::vector<double>, std::vector<double>> read_recorded(std::string_view text);

}  // namespace plekton::apps
