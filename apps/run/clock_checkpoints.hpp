// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace plekton::apps {

/// Checkpoints by the clock on the wall: so that a run that is killed loses no more than that much
/// of it. There is one at a time: each replaces the one before, and one that the scenario asks for
/// by simulated time, or at the end, replaces it too, and those that a run left that was killed. So
/// they leave nothing behind, and what a run writes does not depend on the clock.
class ClockCheckpoints {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param folder    of the run
  /// @param interval  s, > 0; nothing: there are none
  ClockCheckpoints(std::filesystem::path folder, std::optional<double> interval);

  bool is_due() const { return Clock::now() >= next_; }

  /// One has been written, complete.
  void written(std::int64_t step);
  /// One that stays has been written, complete.
  void replaced();

 private:
  void wait_again();

  std::filesystem::path folder_;
  std::optional<std::chrono::duration<double>> interval_;
  Clock::time_point next_ = Clock::time_point::max();
};

}  // namespace plekton::apps
