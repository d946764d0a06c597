// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/hdf5/trial.hpp"

#include "dynamics/hdf5/handle.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <exception>

namespace plekton::dynamics::hdf5 {
namespace {

/// In the process of its own. Dies of what kills it, without a word.
[[noreturn]] void run_alone(geometry::FunctionRef<void()> function, unsigned seconds, int to) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGILL}) std::signal(signal, SIG_DFL);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const rlimit time{seconds, seconds};
  ::setrlimit(RLIMIT_CPU, &time);
  std::string said;
  try {
    function();
  } catch (const std::exception& error) {
    said = error.what();
  }
  constexpr std::size_t kMost = 2048;  // bytes, which a pipe takes at once
  said.resize(std::min(said.size(), kMost));
  const bool is_said = said.empty() || ::write(to, said.data(), said.size()) > 0;
  ::_exit(is_said ? 0 : 1);
}

/// @returns the process, or below 0 where none could be made. In the copy there is no other thread
/// that could let go of the library: it is this one that uses it.
pid_t fork_in_use(geometry::FunctionRef<void()> function, unsigned seconds, int to) {
  const LibraryUse use;
  const pid_t child = ::fork();
  if (child == 0) run_alone(function, seconds, to);
  return child;
}

/// All that comes out of a pipe up to its end.
std::string text_from(int pipe) {
  std::string text;
  std::array<char, 1024> buffer{};
  while (true) {
    const ssize_t count = ::read(pipe, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

Trial try_out(geometry::FunctionRef<void()> function, unsigned seconds) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) return {};
  const pid_t child = fork_in_use(function, seconds, ends[1]);
  ::close(ends[1]);
  Trial trial;
  const std::string said = child < 0 ? "" : text_from(ends[0]);
  ::close(ends[0]);
  if (!said.empty()) trial.error = said;
  int status = 0;
  while (child > 0 && ::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return trial;
  trial.was_killed = !(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  return trial;
}

}  // namespace plekton::dynamics::hdf5
