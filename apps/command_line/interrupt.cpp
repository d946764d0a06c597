// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/interrupt.hpp"

namespace plekton::apps {
namespace {

// A signal handler can reach nothing else.
volatile std::sig_atomic_t signal_seen = 0;

extern "C" void note_signal(int) {
  signal_seen = 1;
}

}  // namespace

InterruptGuard::InterruptGuard() {
  signal_seen = 0;
  struct sigaction action {};
  action.sa_handler = note_signal;
  // The second signal meets the default action. SA_RESTART: a write in progress is not cut short.
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kNoted.size(); ++i) {
    sigaction(kNoted[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) sigaction(kNoted[i], &action, nullptr);
  }
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &ignore, &before_pipe_);
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t i = 0; i < kNoted.size(); ++i) sigaction(kNoted[i], &before_[i], nullptr);
  sigaction(SIGPIPE, &before_pipe_, nullptr);
}

bool InterruptGuard::interrupted() const noexcept {
  return signal_seen != 0;
}

}  // namespace plekton::apps
