// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace plekton::apps {

/// A word as a shell takes it: in quotes if there is anything in it that could mean something.
std::string shell_word(const std::string& text);

}  // namespace plekton::apps
