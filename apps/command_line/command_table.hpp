// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

/// The commands of the program as a table, of what it understands itself: the manual page, the
/// completion of shells and the reference are written from it.
namespace plekton::apps {

struct CommandOption {
  std::string name;  ///< as in "--out"; of an argument as in "scenario"
  std::string what;
  int values = 0;  ///< at most; 0 of a flag
  bool needs_value = false;
  std::string value;  ///< what stands for it, as in "OUT", "STAGE DIR"
  bool is_argument = false;
  bool is_required = false;
};

struct CommandEntry {
  std::string name;
  std::string what;
  std::vector<CommandOption> options;  ///< arguments first
};

/// Every command that is not hidden, in the order of the help.
std::vector<CommandEntry> command_table(const CLI::App& app);

/// How an option is written, as in "--out OUT", "[--serve [PORT]]" without the outer brackets.
std::string usage_of(const CommandOption& option);
/// How a command is written, as in "plekton view RUN [--out FILE]".
std::string usage_of(const CommandEntry& command);

}  // namespace plekton::apps
