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
  remove_last(step);
  last_ = step;
  wait_again();
}

void ClockCheckpoints::replaced_by(std::int64_t step) {
  remove_last(step);
  wait_again();
}

/// From now on, so that a checkpoint which takes long does not come again at once.
void ClockCheckpoints::wait_again() {
  constexpr std::chrono::duration<double> kLongest = std::chrono::hours(24 * 365);
  if (!interval_) return;
  next_ =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::min(*interval_, kLongest));
}

/// @param now  step of the one that has come after it: of the same step it is in its place already
void ClockCheckpoints::remove_last(std::int64_t now) {
  if (last_ && *last_ != now) remove_run_checkpoint(folder_, *last_);
  last_.reset();
}

}  // namespace plekton::apps
