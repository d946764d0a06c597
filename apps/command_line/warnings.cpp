// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/warnings.hpp"

#include "geometry/base/printable.hpp"

#include <ostream>

namespace plekton::apps {

void print_warnings(std::span<const std::string> warnings, std::ostream& problems) {
  for (const std::string& warning : warnings)
    problems << "plekton: warning: " << geometry::printable(warning) << '\n';
}

}  // namespace plekton::apps
