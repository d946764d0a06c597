// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace plekton::apps {

/// What is wrong with a command line that was not understood, and what was probably meant, in one
/// sentence.
/// @param app    which has tried to parse it
/// @param first  word after the name of the program; empty if there is none
std::string usage_error(const CLI::App& app, const CLI::ParseError& error,
                        const std::string& first);

}  // namespace plekton::apps
