// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <string>

namespace plekton::apps {

/// What an error says to whoever reads it. @returns a text that lives as long as the error
const char* text_of(const std::exception& error);

/// One problem after the name of the program, several below it. A line that begins with a blank
/// goes on with the problem before it.
void print_error(const std::string& text);

}  // namespace plekton::apps
