// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/thread_pool.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace plekton::geometry {
namespace {

/// Tells the processor that this thread is waiting.
void pause() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

// How often is looked, some 15 ns each.
constexpr int kLooksForBegin = 128;    // for others to begin their parts, which are short
constexpr int kLooksForChange = 1024;  // for a loop of a step to begin or end

// A thread that loses its core gets it back after a slice of the scheduler, some milliseconds. Loops
// that are late for that are no faster than the caller alone if they take more time than the others.
constexpr std::chrono::microseconds kLongWait{300};
constexpr std::chrono::milliseconds kLongLoop{1};
constexpr std::chrono::milliseconds kTooLate{5};
constexpr std::chrono::milliseconds kShortestAlone{10};
constexpr std::chrono::milliseconds kLongestAlone{1000};
constexpr int kTrial = 8;  // times as long as they were left alone: late again

/// Waits until a value is no longer the old one: looks for a while, then blocks. A thread that
/// blocks gets its core back sooner than one that gave it away in between its looks.
void wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t old) noexcept {
  for (int look = 0; look < kLooksForChange; ++look) {
    if (value.load(std::memory_order_acquire) != old) return;
    pause();
  }
  value.wait(old, std::memory_order_acquire);
}

std::logic_error loop_in_loop() {
  return std::logic_error(
      "ThreadPool: a loop was begun while a loop of the same pool is running; use the indices of "
      "the outer loop, or another pool");
}

int checked(int thread_count) {
  if (thread_count < 1) {
    throw std::invalid_argument("ThreadPool: got " + std::to_string(thread_count) +
                                " threads, expected at least 1; the calling thread counts as one");
  }
  return thread_count;
}

/// More threads than processors would take turns on them.
int threads_beside_caller(int thread_count) noexcept {
  const auto processors = static_cast<int>(std::thread::hardware_concurrency());
  return std::min(thread_count, std::max(processors, 2)) - 1;
}

}  // namespace

ThreadPool::ThreadPool(int thread_count)
    : thread_count_(checked(thread_count)),
      threads_beside_(threads_beside_caller(thread_count)),
      failures_(static_cast<std::size_t>(thread_count)),
      parts_(static_cast<std::size_t>(thread_count)) {
  threads_.reserve(static_cast<std::size_t>(threads_beside_));
  try {
    for (int worker = 1; worker <= threads_beside_; ++worker) {
      threads_.emplace_back([this, worker] { work(worker); });
    }
  } catch (...) {
    stop();
    throw;
  }
}

ThreadPool::~ThreadPool() {
  stop();
}

void ThreadPool::stop() noexcept {
  stopping_ = true;
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  threads_.clear();  // Joins them.
}

void ThreadPool::run(const Task& task) {
  if (busy_.exchange(true, std::memory_order_acquire)) throw loop_in_loop();
  task_ = task;
  if (!run_alone()) run_with_others();
  std::exception_ptr first;
  for (std::exception_ptr& failure : failures_) {
    if (failure && !first) first = failure;
    failure = nullptr;
  }
  busy_.store(false, std::memory_order_release);
  if (first) std::rethrow_exception(first);
}

bool ThreadPool::run_alone() noexcept {
  is_alone_ = is_alone_ && Clock::now() < alone_until_;
  if (!is_alone_) return false;
  for (int worker = 0; worker < thread_count_; ++worker) do_part(worker);
  return true;
}

void ThreadPool::run_with_others() noexcept {
  const Clock::time_point start = Clock::now();
  unfinished_.store(static_cast<std::uint32_t>(thread_count_ - 1), std::memory_order_relaxed);
  const std::uint32_t round = round_.fetch_add(1, std::memory_order_release) + 1;
  round_.notify_all();
  do_part(0);
  do_all_left(threads_beside_ + 1, round);
  judge(start, !is_finished_soon() && finish_late(start, round));
}

bool ThreadPool::finish_late(Clock::time_point start, std::uint32_t round) noexcept {
  const Clock::time_point done = Clock::now();
  const bool was_left = do_all_left(1, round);
  const Clock::time_point waiting = Clock::now();
  for (std::uint32_t left = unfinished_.load(std::memory_order_acquire); left != 0;
       left = unfinished_.load(std::memory_order_acquire)) {
    wait_for_change(unfinished_, left);
  }
  return was_left || Clock::now() - waiting > std::max<Clock::duration>(kLongWait, done - start);
}

void ThreadPool::judge(Clock::time_point start, bool was_late) noexcept {
  const Clock::time_point now = Clock::now();
  if (!was_late) {
    // The caller may have lost its own core in a long one, which tells nothing of the others.
    lateness_ -= std::min<Clock::duration>(now - start, kLongLoop);
    lateness_ = std::max(lateness_, Clock::duration{});
    return;
  }
  lateness_ += now - start;
  if (lateness_ < kTooLate) return;
  const bool again = now - alone_until_ < kTrial * alone_for_;
  alone_for_ = again ? std::min<Clock::duration>(4 * alone_for_, kLongestAlone) : kShortestAlone;
  alone_until_ = now + alone_for_;
  is_alone_ = true;
  lateness_ = {};
}

bool ThreadPool::is_finished_soon() const noexcept {
  for (int look = 0; look < kLooksForBegin; ++look) {
    if (unfinished_.load(std::memory_order_acquire) == 0) return true;
    pause();
  }
  return false;
}

/// A thread that comes late may miss rounds: others have done its part.
void ThreadPool::work(int worker) {
  for (std::uint32_t round = 0;;) {
    wait_for_change(round_, round);
    round = round_.load(std::memory_order_acquire);
    if (stopping_) return;
    do_if_left(worker, round);
    do_all_left(threads_beside_ + 1, round);
  }
}

/// A round is not over before all of its parts have been begun, so the task is that of the round.
bool ThreadPool::do_if_left(int worker, std::uint32_t round) noexcept {
  std::uint32_t before = round - 1;
  if (!parts_[static_cast<std::size_t>(worker)].last_begun.compare_exchange_strong(
          before, round, std::memory_order_relaxed))
    return false;
  do_part(worker);
  if (unfinished_.fetch_sub(1, std::memory_order_acq_rel) == 1) unfinished_.notify_one();
  return true;
}

bool ThreadPool::do_all_left(int first, std::uint32_t round) noexcept {
  bool was_left = false;
  for (int worker = first; worker < thread_count_; ++worker) was_left |= do_if_left(worker, round);
  return was_left;
}

void ThreadPool::do_part(int worker) noexcept {
  const auto [begin, end] = part(task_.count, static_cast<std::size_t>(worker));
  try {
    task_.call(task_.body, begin, end, worker);
  } catch (...) {
    failures_[static_cast<std::size_t>(worker)] = std::current_exception();
  }
}

ThreadPool::Part ThreadPool::part(std::size_t count, std::size_t worker) const noexcept {
  const auto parts = static_cast<std::size_t>(thread_count_);
  const std::size_t length = count / parts;
  const std::size_t longer = count % parts;  // The first parts have one more.
  const std::size_t begin = worker * length + std::min(worker, longer);
  return {begin, begin + length + (worker < longer ? 1 : 0)};
}

void ThreadPool::share_out(std::size_t count) {
  if (busy_.load(std::memory_order_relaxed)) throw loop_in_loop();
  for (std::size_t worker = 0; worker < parts_.size(); ++worker) {
    const auto [begin, end] = part(count, worker);
    parts_[worker].rest.store(std::uint64_t{begin} << 32 | end, std::memory_order_relaxed);
  }
}

void ThreadPool::wait_for_late(Clock::time_point start, std::size_t pieces) const noexcept {
  if (is_alone_) return;
  const Clock::time_point done = Clock::now();
  const Clock::time_point end = done + (done - start) / static_cast<std::int64_t>(pieces);
  const auto is_taken = [](const SharedPart& part) { return part.is_taken(); };
  while (!std::all_of(parts_.begin(), parts_.end(), is_taken) && Clock::now() < end) pause();
}

bool ThreadPool::SharedPart::is_taken() const noexcept {
  const std::uint64_t left = rest.load(std::memory_order_relaxed);
  return left >> 32 >= (left & kEnd);
}

// What is left only shrinks while a loop runs, so that an old value never comes back.

bool ThreadPool::SharedPart::take_first(std::size_t& index) noexcept {
  std::uint64_t left = rest.load(std::memory_order_relaxed);
  do {
    index = left >> 32;
    if (index >= (left & kEnd)) return false;
  } while (!rest.compare_exchange_weak(left, left + kOne, std::memory_order_relaxed));
  return true;
}

bool ThreadPool::SharedPart::take_last(std::size_t& index) noexcept {
  std::uint64_t left = rest.load(std::memory_order_relaxed);
  do {
    index = (left & kEnd) - 1;
    if (left >> 32 >= (left & kEnd)) return false;
  } while (!rest.compare_exchange_weak(left, left - 1, std::memory_order_relaxed));
  return true;
}

}  // namespace plekton::geometry
