// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <thread>
#include <type_traits>
#include <vector>

namespace plekton::geometry {

/// A fixed set of threads that share loops. Idle threads sleep: after a short while of looking for
/// work they block, so they take no core from others. Nobody waits for a thread that has not begun:
/// the caller does its part. On a machine with other work a thread may also lose its core within
/// its part; where loops have waited for that, the caller does all parts for some time.
///
/// One loop at a time: for_each_range must not be called from inside a body of the same pool, nor
/// by two threads at once, unless the pool has one thread.
class ThreadPool {
 public:
  /// @param thread_count How many parts a loop has. The calling thread does at least one of them:
  /// n starts n - 1 threads, but no more than there are processors beside that of the caller, and
  /// one at least; more would only take turns.
  /// @throws std::invalid_argument if it is less than 1; std::system_error if the system gives no
  /// thread.
  explicit ThreadPool(int thread_count = 1);
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  ~ThreadPool();

  int thread_count() const noexcept { return thread_count_; }

  /// Calls body(begin, end, worker) once for every worker in [0, thread_count()), each on whichever
  /// thread comes to it, and waits for all. No call may wait for another one. The parts [begin,
  /// end) follow each other in the order of the workers, cover [0, count) and differ by at most 1
  /// in length; they depend on count and thread_count() alone.
  /// With fewer indices than threads the later parts are empty (begin == end) and their workers are
  /// called all the same; with none at all nobody is called. The calling thread does the part of
  /// worker 0; with one thread this is a plain call. No allocation unless a body throws.
  /// @throws What a body threw, after all have ended; the lowest worker's if several did.
  ///         std::logic_error if a loop of this pool is running.
  template <class Body>
  void for_each_range(std::size_t count, Body&& body) {
    if (count == 0) return;
    if (thread_count_ == 1) {
      body(std::size_t{0}, count, 0);
      return;
    }
    using Plain = std::remove_reference_t<Body>;
    run({count, const_cast<std::remove_const_t<Plain>*>(std::addressof(body)),
         [](void* erased, std::size_t begin, std::size_t end, int worker) {
           (*static_cast<Plain*>(erased))(begin, end, worker);
         }});
  }

  /// Calls body(index, worker) once for every index in [0, count), and waits for all: for pieces of
  /// work that take long, where a thread may be kept from its core by others. A worker goes through
  /// its part of for_each_range in ascending order. Whoever is done waits about as long as one of
  /// its indices has taken, and then takes from the ends of the parts of those that are late: not
  /// at once, since another core has what belongs to an index in its cache. So it is not fixed
  /// which worker gets an index: what body does must depend on the index alone.
  /// @param count  < 2^32
  /// @throws as for_each_range; after a throw some indices may have been left out
  template <class Body>
  void for_each_shared(std::size_t count, Body&& body) {
    if (count == 0) return;
    if (thread_count_ == 1) {
      for (std::size_t index = 0; index < count; ++index) body(index, 0);
      return;
    }
    share_out(count);
    for_each_range(count, [&](std::size_t begin, std::size_t end, int worker) {
      const auto start = std::chrono::steady_clock::now();
      std::size_t index;
      while (parts_[static_cast<std::size_t>(worker)].take_first(index)) body(index, worker);
      wait_for_late(start, std::max<std::size_t>(end - begin, 1));
      for (SharedPart& part : parts_) {
        while (part.take_last(index)) body(index, worker);
      }
    });
  }

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
    void* body;
    void (*call)(void* body, std::size_t begin, std::size_t end, int worker);
  };

  void run(const Task& task);
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

}  // namespace plekton::geometry
