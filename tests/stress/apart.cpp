// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/stress/apart.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

namespace plekton::stress {
namespace {

[[noreturn]] void work_in_child(const std::function<void(const Tell&)>& work, int out,
                                int processor_time) {
  const int nothing = ::open("/dev/null", O_WRONLY);
  ::dup2(nothing, STDOUT_FILENO);
  ::dup2(nothing, STDERR_FILENO);
  const auto seconds = static_cast<rlim_t>(processor_time);
  const rlimit limit{seconds, seconds + 1};
  ::setrlimit(RLIMIT_CPU, &limit);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  work([out](const std::string& text) {
    for (std::size_t at = 0; at < text.size();) {
      const ::ssize_t written = ::write(out, text.data() + at, text.size() - at);
      if (written <= 0) ::_exit(2);
      at += static_cast<std::size_t>(written);
    }
  });
  ::_exit(0);
}

}  // namespace

Apart do_apart(const std::function<void(const Tell&)>& work, int processor_time) {
  using Clock = std::chrono::steady_clock;
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) throw std::runtime_error("cannot make a pipe");
  const ::pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) {
    ::close(ends[0]);
    work_in_child(work, ends[1], processor_time);
  }
  ::close(ends[1]);
  Apart apart;
  const auto end = Clock::now() + std::chrono::seconds(10 * processor_time);
  std::array<char, 4096> buffer{};
  while (true) {
    pollfd waiting{ends[0], POLLIN, 0};
    if (::poll(&waiting, 1, 1000) > 0) {
      const ::ssize_t count = ::read(ends[0], buffer.data(), buffer.size());
      if (count <= 0) break;
      apart.told.append(buffer.data(), static_cast<std::size_t>(count));
    } else if (Clock::now() > end) {
      ::kill(child, SIGKILL);
      apart.hung = true;
      break;
    }
  }
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) apart.signal = WTERMSIG(status);
  // A limit of processor time ends with the one or the other.
  apart.hung = apart.hung || apart.signal == SIGXCPU || apart.signal == SIGKILL;
  return apart;
}

}  // namespace plekton::stress
