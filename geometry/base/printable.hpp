// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace plekton::geometry {

/// A text for a terminal, in one line: control characters are written as in "\\n" and "\\x1b". A
/// line break before two spaces goes on with the same message and stays.
std::string printable(std::string_view text);

}  // namespace plekton::geometry
