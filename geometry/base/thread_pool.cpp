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

/// Waits until a value is no longer the old one: looks a number of times, most of them leaving the
/// core to others in between, then blocks. The first looks are as near to each other as threads
/// that end a loop at nearly the same time, and cost less than a call of the system.
void wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t old,
                     int looks) noexcept {
  constexpr int kNearLooks = 512;
  for (int look = 0; look < looks; ++look) {
    for (int near = 0; near < (look == 0 ? kNearLooks : 1); ++near) {
      if (value.load(std::memory_order_acquire) != old) return;
      pause();
    }
    std::this_thread::yield();
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

/// About 20 us of looking, the time a step leaves between two loops; none when the threads
/// outnumber the cores.
int looks_for(int thread_count) noexcept {
  const unsigned cores = std::thread::hardware_concurrency();
  return cores >= static_cast<unsigned>(thread_count) ? 64 : 0;
}

}  // namespace

ThreadPool::ThreadPool(int thread_count)
    : thread_count_(checked(thread_count)),
      looks_(looks_for(thread_count)),
      failures_(static_cast<std::size_t>(thread_count)),
      parts_(static_cast<std::size_t>(thread_count)) {
  threads_.reserve(static_cast<std::size_t>(thread_count - 1));
  try {
    for (int worker = 1; worker < thread_count; ++worker) {
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
  unfinished_.store(static_cast<std::uint32_t>(thread_count_ - 1), std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  do_part(0);
  for (std::uint32_t left = unfinished_.load(std::memory_order_acquire); left != 0;
       left = unfinished_.load(std::memory_order_acquire)) {
    wait_for_change(unfinished_, left, looks_);
  }
  std::exception_ptr first;
  for (std::exception_ptr& failure : failures_) {
    if (failure && !first) first = failure;
    failure = nullptr;
  }
  busy_.store(false, std::memory_order_release);
  if (first) std::rethrow_exception(first);
}

void ThreadPool::work(int worker) {
  for (std::uint32_t seen = 0;;
       ++seen) {  // The next round cannot start before this worker has finished the last one.
    wait_for_change(round_, seen, looks_);
    if (stopping_) return;
    do_part(worker);
    if (unfinished_.fetch_sub(1, std::memory_order_acq_rel) == 1) unfinished_.notify_one();
  }
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

void ThreadPool::wait_for_late(std::chrono::steady_clock::time_point start,
                               std::size_t pieces) const noexcept {
  using Clock = std::chrono::steady_clock;
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
