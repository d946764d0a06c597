// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/command.hpp"

#include "apps/scenario/problems.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <iostream>
#include <system_error>

namespace plekton::apps {

void flush_output() {
  if (std::cout.flush()) return;
  throw InputError(
      fmt::format("standard output: cannot be written: {}; what is missing there is "
                  "lost, repeat the command",
                  std::generic_category().message(errno)));
}

}  // namespace plekton::apps
