// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace plekton::geometry {

/// Throws what was found wrong with an input, all of it at once.
/// @param problems  a line each, with its line end
/// @throws std::invalid_argument with these lines, if there are any
inline void throw_if_any(const std::ostringstream& problems) {
  if (const std::string text = problems.str(); !text.empty()) {
    throw std::invalid_argument(text.substr(0, text.size() - 1));
  }
}

}  // namespace plekton::geometry
