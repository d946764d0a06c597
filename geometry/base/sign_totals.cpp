// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/sign_totals.hpp"

#include <atomic>
#include <mutex>

namespace plekton::geometry {
namespace {

/// Read by sign_totals() while its thread counts: each access is atomic. Only its own thread
/// writes, so that a plain store is enough, which costs no more than an ordinary one.
std::uint64_t read(std::uint64_t& counter) noexcept {
  return std::atomic_ref<std::uint64_t>(counter).load(std::memory_order_relaxed);
}

void add(SignCounters& sum, SignCounters& counters) noexcept {
  sum.double_double += read(counters.double_double);
  sum.interval += read(counters.interval);
  sum.exact += read(counters.exact);
}

class CountersOfThread;

/// A list of the threads that count, and what those have counted that ended.
struct Register {
  std::mutex mutex;
  CountersOfThread* first = nullptr;
  SignCounters ended;
};

/// Never destroyed: threads may end after everything that is static has gone.
Register& all_threads() noexcept {
  static Register& all = *new Register;
  return all;
}

class CountersOfThread {
 public:
  CountersOfThread() {
    Register& all = all_threads();
    const std::lock_guard lock(all.mutex);
    next_ = all.first;
    if (next_ != nullptr) next_->previous_ = this;
    all.first = this;
  }
  CountersOfThread(const CountersOfThread&) = delete;
  CountersOfThread& operator=(const CountersOfThread&) = delete;
  ~CountersOfThread() {
    Register& all = all_threads();
    const std::lock_guard lock(all.mutex);
    add(all.ended, counters);
    (previous_ != nullptr ? previous_->next_ : all.first) = next_;
    if (next_ != nullptr) next_->previous_ = previous_;
  }

  const CountersOfThread* next() const noexcept { return next_; }

  mutable SignCounters counters;

 private:
  CountersOfThread* previous_ = nullptr;
  CountersOfThread* next_ = nullptr;
};

}  // namespace

SignCounters& sign_counters() noexcept {
  thread_local CountersOfThread of_thread;
  return of_thread.counters;
}

void count_sign(std::uint64_t& counter) noexcept {
  std::atomic_ref<std::uint64_t>(counter).store(counter + 1, std::memory_order_relaxed);
}

SignCounters sign_totals() noexcept {
  Register& all = all_threads();
  const std::lock_guard lock(all.mutex);
  SignCounters sum = all.ended;
  for (const CountersOfThread* thread = all.first; thread != nullptr; thread = thread->next())
    add(sum, thread->counters);
  return sum;
}

}  // namespace plekton::geometry
