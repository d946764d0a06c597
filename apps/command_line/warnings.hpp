// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <span>
#include <string>

namespace plekton::apps {

/// Says what whoever reads results has to know, a line for each.
void print_warnings(std::span<const std::string> warnings, std::ostream& problems);

}  // namespace plekton::apps
