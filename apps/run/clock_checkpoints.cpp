// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/clock_checkpoints.hpp"

#include "apps/run/checkpoints.hpp"

#include <algorithm>
#include <utility>

namespace plekton::apps {

ClockCheckpoints::ClockCheckpoints(std::filesystem::path folder, std::optional<double> interval)
    : folder_(std::move(folder)) {
  if (interval) interval_.emplace(*interval);
  wait_again();
}

void ClockCheckpoints::written(std::int64_t step) {
  remove_clock_checkpoints(folder_, step);
  wait_again();
}

void ClockCheckpoints::replaced() {
  remove_clock_checkpoints(folder_);
  wait_again();
}

/// From now on, so that a checkpoint which takes long does not come again at once.
void ClockCheckpoints::wait_again() {
  constexpr std::chrono::duration<double> kLongest = std::chrono::hours(24 * 365);
  if (!interval_) return;
  next_ =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::min(*interval_, kLongest));
}

}  // namespace plekton::apps
