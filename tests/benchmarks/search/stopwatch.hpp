// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ctime>

namespace plekton::benchmarks {

/// Of processor time, which other work on the machine disturbs less.
class Stopwatch {
 public:
  /// s, since it was made or last asked.
  double lap() {
    const double before = start_;
    start_ = now();
    return start_ - before;
  }

 private:
  static double now() {
    std::timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  double start_ = now();
};

}  // namespace plekton::benchmarks
