// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

namespace plekton::stress {

/// How a process ended.
struct Apart {
  std::string told;  ///< all that it wrote, also until a crash
  int signal = 0;    ///< that ended it; 0: none
  bool hung = false;
};

/// Writes to the process that waits.
using Tell = std::function<void(const std::string&)>;

/// Does something in a process of its own, with nothing on its standard output and error.
/// @param processor_time  s, after which it hangs; of time on the clock ten times that
Apart do_apart(const std::function<void(const Tell&)>& work, int processor_time);

}  // namespace plekton::stress
