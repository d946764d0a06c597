// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/thread_pool.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace plekton::geometry {
namespace {

/// Waits until a value is no longer the old one: looks a number of times, leaving the core to
/// others in between, then blocks.
void wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t old,
                     int looks) noexcept {
  for (int look = 0; look < looks; ++look) {
    if (value.load(std::memory_order_acquire) != old) return;
    std::this_thread::yield();
  }
  value.wait(old, std::memory_order_acquire);
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
      failures_(static_cast<std::size_t>(thread_count)) {
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
  if (busy_.exchange(true, std::memory_order_acquire)) {
    throw std::logic_error(
        "ThreadPool: for_each_range was called while a loop of the same pool is running; use the "
        "indices of the outer "
        "loop, or another pool");
  }
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
  const auto part = static_cast<std::size_t>(worker);
  const auto parts = static_cast<std::size_t>(thread_count_);
  const std::size_t length = task_.count / parts;
  const std::size_t longer = task_.count % parts;  // The first parts have one more.
  const std::size_t begin = part * length + std::min(part, longer);
  const std::size_t end = begin + length + (part < longer ? 1 : 0);
  try {
    task_.call(task_.body, begin, end, worker);
  } catch (...) {
    failures_[part] = std::current_exception();
  }
}

}  // namespace plekton::geometry
