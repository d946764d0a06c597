// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <csignal>

namespace plekton::apps {

/// While it lives, SIGINT (Ctrl-C) and SIGTERM are noted instead of ending the program; a second
/// one ends it as usual. At most one at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  ~InterruptGuard();

  bool interrupted() const noexcept;

 private:
  struct sigaction before_int_ {};
  struct sigaction before_term_ {};
};

}  // namespace plekton::apps
