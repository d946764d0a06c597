// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace plekton::apps {

/// A command of the program. A function in a file of its own adds it to the others; what is given
/// to its options is written to where `run` reads it.
struct ProgramCommand {
  const CLI::App* options;   ///< which reads what is given to it
  std::function<int()> run;  ///< does what it says; @returns an ExitCode
};

/// For commands whose result is what they print. @throws InputError if it has not arrived
void flush_output();

}  // namespace plekton::apps
