// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plekton::apps {
namespace {

constexpr std::chrono::milliseconds kPause{200};
constexpr std::chrono::seconds kQuietStart{1};  // of a setting up that is told in lines
constexpr std::chrono::seconds kPauseOfLines{5};

double seconds(Progress::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// Characters, of a line of a narrow terminal.
constexpr std::size_t kTerminal = 80;

/// Writes a line over another one. @returns its width
std::size_t write_over(std::ostream& out, const std::string& line, std::size_t width) {
  out << '\r' << line << std::string(width > line.size() ? width - line.size() : 0, ' ')
      << std::flush;
  return line.size();
}

}  // namespace

std::string duration_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::ceil(std::clamp(seconds, 0.0, 1e9)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

SetUpProgress::SetUpProgress(std::ostream& out, ProgressStyle style, Clock::time_point start,
                             std::string task)
    : out_(out), style_(style), task_(std::move(task)), start_(start), last_(start) {
  if (style == ProgressStyle::lines)
    teller_ = std::jthread([this](const std::stop_token& stop) { tell_now_and_then(stop); });
}

SetUpProgress::~SetUpProgress() {
  const std::lock_guard lock(mutex_);
  if (width_ > 0) write_over(out_, "", width_);
  if (width_ > 0) out_ << '\r' << std::flush;
}

bool SetUpProgress::is_due(bool begins, Clock::time_point now) const {
  if (style_ == ProgressStyle::one_line) return begins || now - last_ >= kPause;
  return now - start_ >= kQuietStart && (begins || now - last_ >= kPauseOfLines);
}

void SetUpProgress::update(const std::string& what, double share, Clock::time_point now) {
  if (style_ == ProgressStyle::none) return;
  const std::lock_guard lock(mutex_);
  now_ = what;
  share_ = share;
  tell(now);
}

void SetUpProgress::tell_now_and_then(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    ends_.wait_for(lock, stop, kQuietStart, [] { return false; });
    if (!stop.stop_requested()) tell(Clock::now());
  }
}

void SetUpProgress::tell(Clock::time_point now) {
  if (now_.empty() || !is_due(now_ != what_, now)) return;
  const bool is_new = now_ != what_;
  what_ = now_;
  last_ = now;
  std::string line = task_ + ": " + what_;
  if (share_ > 0.0) line += fmt::format(", {:.0f} %", 100.0 * share_);
  if (style_ != ProgressStyle::one_line) {
    out_ << line << std::endl;
  } else if (line.size() < kTerminal) {
    width_ = write_over(out_, line, width_);
  } else if (is_new) {  // what takes more than a line of it cannot be written over
    write_over(out_, "", width_);
    out_ << '\r' << line << std::endl;
    width_ = 0;
  }
}

Progress::Progress(std::ostream& out, ProgressStyle style, double duration)
    : out_(out), style_(style), duration_(duration) {}

bool Progress::is_due(double time, Clock::time_point now) const {
  if (style_ == ProgressStyle::one_line) return now - last_ >= kPause;
  return static_cast<int>(10.0 * time / duration_) > tenths_;
}

std::string Progress::text(double time, std::int64_t steps, Clock::time_point now) {
  const double since_last = seconds(now - last_);
  const double rate =
      since_last > 0.0 ? static_cast<double>(steps - last_steps_) / since_last : 0.0;
  const double share = std::clamp(time / duration_, 0.0, 1.0);
  // From the whole run so far: steadier than the rate of a moment.
  const double left = share > 0.0 ? seconds(now - start_) * (1.0 - share) / share : 0.0;
  return fmt::format("{:3.0f} %  {:.4g} of {:.4g} s  {:.0f} steps/s  {} left", 100.0 * share, time,
                     duration_, rate, duration_text(left));
}

void Progress::update(double time, std::int64_t steps, Clock::time_point now) {
  if (style_ == ProgressStyle::none) return;
  if (!started_) {
    started_ = true;
    start_ = last_ = now;
    last_steps_ = steps;
    tenths_ = static_cast<int>(10.0 * time / duration_);
    return;
  }
  if (!is_due(time, now)) return;
  const std::string line = text(time, steps, now);
  if (style_ == ProgressStyle::one_line) {
    width_ = write_over(out_, line, width_);
  } else {
    out_ << line << std::endl;
  }
  last_ = now;
  last_steps_ = steps;
  tenths_ = static_cast<int>(10.0 * time / duration_);
}

void Progress::finish() {
  if (width_ > 0) out_ << std::endl;
  width_ = 0;
}

}  // namespace plekton::apps
