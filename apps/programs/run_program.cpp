// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/programs/run_program.hpp"

#include "apps/programs/child_process.hpp"
#include "apps/scenario/problems.hpp"
#include "geometry/base/regular_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <sstream>
#include <system_error>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

/// The last line that speaks of an error, or else the last of all: what comes after an error is often
/// no more than that the program ends.
std::string what_was_said(const fs::path& log) {
  std::string last;
  std::string error;
  std::istringstream lines(geometry::read_regular_file(log, "a log"));
  for (std::string line; std::getline(lines, line);) {
    if (line.find_first_not_of(" \t") == std::string::npos) continue;
    last = line;
    if (line.find("rror") != std::string::npos) error = line;
  }
  return error.empty() ? last : error;
}

}  // namespace

void run_to_end(const std::vector<std::string>& arguments, const fs::path& log) {
  const int output = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (output < 0)
    throw InputError(fmt::format("{}: cannot be written: {}", log.string(),
                                 std::generic_category().message(errno)));
  ProgramEnd end;
  {
    ChildProcess child(arguments, output);
    ::close(output);
    end = child.wait();
  }
  if (end.exit_code == 0) return;
  throw InputError(fmt::format("{}: ended with {}; it said: {}", arguments.front(), text_of(end),
                               what_was_said(log)));
}

}  // namespace plekton::apps
