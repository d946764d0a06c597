// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <csignal>

namespace plekton::apps {

/// While it lives, SIGINT (Ctrl-C), SIGTERM and SIGHUP (the terminal was closed) are noted instead
/// of ending the program; a second one ends it as usual. One that was ignored before (nohup) stays
/// ignored. SIGPIPE is ignored: that nobody reads the progress any more is no reason to lose a run.
/// At most one at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  ~InterruptGuard();

  bool interrupted() const noexcept;

 private:
  static constexpr std::array kNoted = {SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, kNoted.size()> before_{};
  struct sigaction before_pipe_ {};
};

}  // namespace plekton::apps
