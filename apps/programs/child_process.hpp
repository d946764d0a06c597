// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Other programs, started without a shell: no name or value can become a command.
namespace plekton::apps {

/// Where a program of this name is, by the folders of PATH.
std::optional<std::filesystem::path> find_program(std::string_view name);

/// How a program ended.
struct ProgramEnd {
  int exit_code = -1;  ///< -1 if a signal ended it
  int signal = 0;      ///< 0 if none did
};

/// "exit code 3", or "signal 9".
std::string text_of(const ProgramEnd& end);

/// A program that runs beside this one, in a process group of its own, so that Ctrl-C reaches it
/// only by way of this program. It is killed where this program ends before it, however that ends.
/// It has the environment of this one, without what says that this is one of several ranks.
class ChildProcess {
 public:
  /// @param arguments  The path of the program and what it is told.
  /// @param output  Descriptor that takes its standard output and error; its input is empty.
  /// @throws std::system_error if there can be no more processes
  ChildProcess(const std::vector<std::string>& arguments, int output);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  /// How it ended, if it has.
  std::optional<ProgramEnd> poll();
  ProgramEnd wait();
  /// Asks it to end (SIGTERM).
  void interrupt() const;

 private:
  std::optional<ProgramEnd> look(int options);

  ::pid_t process_ = -1;
  std::optional<ProgramEnd> end_;
};

}  // namespace plekton::apps
