// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace plekton::apps {

/// A path as a shell and the program behind it take it: in quotes if there is anything in it that
/// could mean something, and with ./ before a dash, which would begin an option.
std::string shell_word(const std::string& path);

}  // namespace plekton::apps
