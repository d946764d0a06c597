// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <ostream>
#include <stop_token>
#include <string>
#include <thread>

namespace plekton::apps {

/// How a progress is shown.
enum class ProgressStyle : std::uint8_t {
  one_line,  ///< a line that is written over, for a terminal
  lines,     ///< a line about every tenth of the way, for a file or a pipe
  none
};

/// "1 h 02 min", "3 min 05 s" or "12 s".
std::string duration_text(double seconds);

/// Tells what is being set up before a run, where that takes longer than a second: in lines every few
/// seconds, also while nothing calls it.
class SetUpProgress {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param task  what lines begin with
  SetUpProgress(std::ostream& out, ProgressStyle style, Clock::time_point start = Clock::now(),
                std::string task = "setting up");
  SetUpProgress(const SetUpProgress&) = delete;
  SetUpProgress& operator=(const SetUpProgress&) = delete;
  /// Leaves an empty line, so that other output can follow.
  ~SetUpProgress();

  /// Call it as often as convenient. On a terminal it writes at once where something else begins,
  /// and several times a second; in lines once the first second is over, and every few seconds.
  /// @param what   as in "placing grains sand"; empty: all is set up
  /// @param share  of it that is done, 0 to 1
  void update(const std::string& what, double share, Clock::time_point now = Clock::now());

 private:
  bool is_due(bool begins, Clock::time_point now) const;
  void tell(Clock::time_point now);
  void tell_now_and_then(const std::stop_token& stop);

  std::ostream& out_;
  ProgressStyle style_;
  std::string task_;
  Clock::time_point start_;
  Clock::time_point last_;  // of the last text
  std::string what_;        // that was told last
  std::string now_;         // what is done now; empty: nothing
  double share_ = 0.0;
  std::size_t width_ = 0;  // of the line that is written over
  std::mutex mutex_;       // of all above
  std::condition_variable_any ends_;
  std::jthread teller_;  // of lines; last, so that it ends first
};

/// Tells how far a run is: percent, simulated time, steps per second, time left.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param duration  s, of simulated time
  Progress(std::ostream& out, ProgressStyle style, double duration);

  /// Call it as often as convenient; it writes several times a second, or every tenth of the way.
  void update(double time, std::int64_t steps, Clock::time_point now = Clock::now());

  /// Ends the line, so that other output can follow.
  void finish();

 private:
  std::string text(double time, std::int64_t steps, Clock::time_point now);
  bool is_due(double time, Clock::time_point now) const;

  std::ostream& out_;
  ProgressStyle style_;
  double duration_;
  Clock::time_point start_;
  bool started_ = false;
  Clock::time_point last_;  // of the last text
  std::int64_t last_steps_ = 0;
  int tenths_ = 0;         // told so far
  std::size_t width_ = 0;  // of the line that is written over
};

}  // namespace plekton::apps
