// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/thread_pool.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

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

/// The threads beside the caller, and what all of them share.
class ThreadPool::Crew {
 public:
  explicit Crew(int thread_count);
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  ~Crew() { stop(); }

  void run(std::size_t count, FunctionRef<void(std::size_t, std::size_t, int)> body);
  void run_shared(std::size_t count, FunctionRef<void(std::size_t, int)> body);

 private:
  using Clock = std::chrono::steady_clock;

  /// Indices of a part that nobody has taken yet.
  struct alignas(64) SharedPart {
    static constexpr std::uint64_t kOne = std::uint64_t{1} << 32;
    static constexpr std::uint64_t kEnd = kOne - 1;
    std::atomic<std::uint64_t> rest;           ///< begin * kOne + end
    std::atomic<std::uint32_t> last_begun{0};  ///< the last round in which somebody has begun it

    bool is_taken() const noexcept;

    /// @returns whether there was any
    bool take_first(std::size_t& index) noexcept;
    bool take_last(std::size_t& index) noexcept;
  };

  struct Part {
    std::size_t begin;
    std::size_t end;
  };

  struct Task {
    std::size_t count;
    const FunctionRef<void(std::size_t, std::size_t, int)>* body;
  };

  /// Does all parts, as long as the others would be late.
  /// @returns whether it has
  bool run_alone() noexcept;
  void run_with_others() noexcept;
  /// @returns whether a part was left for the caller, or took much longer than the caller's own
  bool finish_late(Clock::time_point start, std::uint32_t round) noexcept;
  /// Reckons with a loop, and leaves the others alone where too many have been late.
  void judge(Clock::time_point start, bool was_late) noexcept;
  Part part(std::size_t count, std::size_t worker) const noexcept;
  void share_out(std::size_t count);
  /// Waits until all parts are taken, or for a share of the time since a start, 1 / pieces.
  void wait_for_late(Clock::time_point start, std::size_t pieces) const noexcept;
  void work(int worker);
  /// Does a part unless somebody has begun it in this round, or the round is over.
  /// @returns whether it has
  bool do_if_left(int worker, std::uint32_t round) noexcept;
  /// Those of workers from one on. @returns whether there was any
  bool do_all_left(int first, std::uint32_t round) noexcept;
  void do_part(int worker) noexcept;
  /// Whether all parts are done before long.
  bool is_finished_soon() const noexcept;
  void stop() noexcept;

  int thread_count_;
  int threads_beside_;  // The caller's: they have the parts of workers from 1 on.
  Task task_{};
  std::atomic<bool> stopping_ = false;
  std::atomic<bool> busy_ = false;
  std::vector<std::exception_ptr> failures_;  // One place for each worker.
  std::vector<SharedPart> parts_;             // Likewise.
  Clock::duration lateness_{};                // Time of loops that were late, less that of others.
  Clock::time_point alone_until_{};  // Until when, and for how long, the caller does all parts.
  Clock::duration alone_for_{};
  bool is_alone_ = false;
  // Written by one side and watched by the other: each on its own cache line.
  alignas(64) std::atomic<std::uint32_t> round_ = 0;
  alignas(64) std::atomic<std::uint32_t> unfinished_ = 0;
  std::vector<std::jthread> threads_;
};

ThreadPool::ThreadPool(int thread_count)
    : thread_count_(checked(thread_count)), crew_(std::make_unique<Crew>(thread_count)) {}

ThreadPool::~ThreadPool() = default;

void ThreadPool::run(std::size_t count, FunctionRef<void(std::size_t, std::size_t, int)> body) {
  crew_->run(count, body);
}

void ThreadPool::run_shared(std::size_t count, FunctionRef<void(std::size_t, int)> body) {
  crew_->run_shared(count, body);
}

ThreadPool::Crew::Crew(int thread_count)
    : thread_count_(thread_count),
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

void ThreadPool::Crew::stop() noexcept {
  stopping_ = true;
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  threads_.clear();  // Joins them.
}

void ThreadPool::Crew::run(std::size_t count,
                           FunctionRef<void(std::size_t, std::size_t, int)> body) {
  if (busy_.exchange(true, std::memory_order_acquire)) throw loop_in_loop();
  task_ = {count, &body};
  if (!run_alone()) run_with_others();
  std::exception_ptr first;
  for (std::exception_ptr& failure : failures_) {
    if (failure && !first) first = failure;
    failure = nullptr;
  }
  busy_.store(false, std::memory_order_release);
  if (first) std::rethrow_exception(first);
}

void ThreadPool::Crew::run_shared(std::size_t count, FunctionRef<void(std::size_t, int)> body) {
  share_out(count);
  run(count, [&](std::size_t begin, std::size_t end, int worker) {
    const Clock::time_point start = Clock::now();
    std::size_t index;
    while (parts_[static_cast<std::size_t>(worker)].take_first(index)) body(index, worker);
    wait_for_late(start, std::max<std::size_t>(end - begin, 1));
    for (SharedPart& of_worker : parts_) {
      while (of_worker.take_last(index)) body(index, worker);
    }
  });
}

bool ThreadPool::Crew::run_alone() noexcept {
  is_alone_ = is_alone_ && Clock::now() < alone_until_;
  if (!is_alone_) return false;
  for (int worker = 0; worker < thread_count_; ++worker) do_part(worker);
  return true;
}

void ThreadPool::Crew::run_with_others() noexcept {
  const Clock::time_point start = Clock::now();
  unfinished_.store(static_cast<std::uint32_t>(thread_count_ - 1), std::memory_order_relaxed);
  const std::uint32_t round = round_.fetch_add(1, std::memory_order_release) + 1;
  round_.notify_all();
  do_part(0);
  do_all_left(threads_beside_ + 1, round);
  judge(start, !is_finished_soon() && finish_late(start, round));
}

bool ThreadPool::Crew::finish_late(Clock::time_point start, std::uint32_t round) noexcept {
  const Clock::time_point done = Clock::now();
  const bool was_left = do_all_left(1, round);
  const Clock::time_point waiting = Clock::now();
  for (std::uint32_t left = unfinished_.load(std::memory_order_acquire); left != 0;
       left = unfinished_.load(std::memory_order_acquire)) {
    wait_for_change(unfinished_, left);
  }
  return was_left || Clock::now() - waiting > std::max<Clock::duration>(kLongWait, done - start);
}

void ThreadPool::Crew::judge(Clock::time_point start, bool was_late) noexcept {
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

bool ThreadPool::Crew::is_finished_soon() const noexcept {
  for (int look = 0; look < kLooksForBegin; ++look) {
    if (unfinished_.load(std::memory_order_acquire) == 0) return true;
    pause();
  }
  return false;
}

/// A thread that comes late may miss rounds: others have done its part.
void ThreadPool::Crew::work(int worker) {
  for (std::uint32_t round = 0;;) {
    wait_for_change(round_, round);
    round = round_.load(std::memory_order_acquire);
    if (stopping_) return;
    do_if_left(worker, round);
    do_all_left(threads_beside_ + 1, round);
  }
}

/// A round is not over before all of its parts have been begun, so the task is that of the round.
bool ThreadPool::Crew::do_if_left(int worker, std::uint32_t round) noexcept {
  std::uint32_t before = round - 1;
  if (!parts_[static_cast<std::size_t>(worker)].last_begun.compare_exchange_strong(
          before, round, std::memory_order_relaxed))
    return false;
  do_part(worker);
  if (unfinished_.fetch_sub(1, std::memory_order_acq_rel) == 1) unfinished_.notify_one();
  return true;
}

bool ThreadPool::Crew::do_all_left(int first, std::uint32_t round) noexcept {
  bool was_left = false;
  for (int worker = first; worker < thread_count_; ++worker) was_left |= do_if_left(worker, round);
  return was_left;
}

void ThreadPool::Crew::do_part(int worker) noexcept {
  const auto [begin, end] = part(task_.count, static_cast<std::size_t>(worker));
  try {
    (*task_.body)(begin, end, worker);
  } catch (...) {
    failures_[static_cast<std::size_t>(worker)] = std::current_exception();
  }
}

ThreadPool::Crew::Part ThreadPool::Crew::part(std::size_t count,
                                              std::size_t worker) const noexcept {
  const auto parts = static_cast<std::size_t>(thread_count_);
  const std::size_t length = count / parts;
  const std::size_t longer = count % parts;  // The first parts have one more.
  const std::size_t begin = worker * length + std::min(worker, longer);
  return {begin, begin + length + (worker < longer ? 1 : 0)};
}

void ThreadPool::Crew::share_out(std::size_t count) {
  if (busy_.load(std::memory_order_relaxed)) throw loop_in_loop();
  for (std::size_t worker = 0; worker < parts_.size(); ++worker) {
    const auto [begin, end] = part(count, worker);
    parts_[worker].rest.store(std::uint64_t{begin} << 32 | end, std::memory_order_relaxed);
  }
}

void ThreadPool::Crew::wait_for_late(Clock::time_point start, std::size_t pieces) const noexcept {
  if (is_alone_) return;
  const Clock::time_point done = Clock::now();
  const Clock::time_point end = done + (done - start) / static_cast<std::int64_t>(pieces);
  const auto is_taken = [](const SharedPart& part) { return part.is_taken(); };
  while (!std::all_of(parts_.begin(), parts_.end(), is_taken) && Clock::now() < end) pause();
}

bool ThreadPool::Crew::SharedPart::is_taken() const noexcept {
  const std::uint64_t left = rest.load(std::memory_order_relaxed);
  return left >> 32 >= (left & kEnd);
}

// What is left only shrinks while a loop runs, so that an old value never comes back.

bool ThreadPool::Crew::SharedPart::take_first(std::size_t& index) noexcept {
  std::uint64_t left = rest.load(std::memory_order_relaxed);
  do {
    index = left >> 32;
    if (index >= (left & kEnd)) return false;
  } while (!rest.compare_exchange_weak(left, left + kOne, std::memory_order_relaxed));
  return true;
}

bool ThreadPool::Crew::SharedPart::take_last(std::size_t& index) noexcept {
  std::uint64_t left = rest.load(std::memory_order_relaxed);
  do {
    index = (left & kEnd) - 1;
    if (left >> 32 >= (left & kEnd)) return false;
  } while (!rest.compare_exchange_weak(left, left - 1, std::memory_order_relaxed));
  return true;
}

}  // namespace plekton::geometry
