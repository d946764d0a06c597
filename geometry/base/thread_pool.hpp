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
/// work they block, so they take no core from others.
///
/// One loop at a time: for_each_range must not be called from inside a body of the same pool, nor
/// by two threads at once, unless the pool has one thread.
class ThreadPool {
 public:
  /// @param thread_count The calling thread is one of them: n starts n - 1 threads.
  /// @throws std::invalid_argument if it is less than 1; std::system_error if the system gives no
  /// thread.
  explicit ThreadPool(int thread_count = 1);
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  ~ThreadPool();

  int thread_count() const noexcept { return thread_count_; }

  /// Calls body(begin, end, worker) once for every worker in [0, thread_count()), at the same time,
  /// and waits for all. The parts [begin, end) follow each other in the order of the workers, cover
  /// [0, count) and differ by at most 1 in length; they depend on count and thread_count() alone.
  /// With fewer indices than threads the later parts are empty (begin == end) and their workers are
  /// called all the same; with none at all nobody is called. The calling thread is worker 0; with
  /// one thread this is a plain call. No allocation unless a body throws.
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
  /// Indices of a part that nobody has taken yet.
  struct alignas(64) SharedPart {
    static constexpr std::uint64_t kOne = std::uint64_t{1} << 32;
    static constexpr std::uint64_t kEnd = kOne - 1;
    std::atomic<std::uint64_t> rest;  ///< begin * kOne + end

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
  Part part(std::size_t count, std::size_t worker) const noexcept;
  void share_out(std::size_t count);
  /// Waits until all parts are taken, or for a share of the time since a start, 1 / pieces.
  void wait_for_late(std::chrono::steady_clock::time_point start,
                     std::size_t pieces) const noexcept;
  void work(int worker);
  void do_part(int worker) noexcept;
  void stop() noexcept;

  int thread_count_;
  int looks_;  // How often an idle thread looks for news before it blocks.
  Task task_{};
  bool stopping_ = false;
  std::atomic<bool> busy_ = false;
  std::vector<std::exception_ptr> failures_;  // One place for each worker.
  std::vector<SharedPart> parts_;             // Likewise.
  // Written by one side and watched by the other: each on its own cache line.
  alignas(64) std::atomic<std::uint32_t> round_ = 0;
  alignas(64) std::atomic<std::uint32_t> unfinished_ = 0;
  std::vector<std::jthread> threads_;
};

}  // namespace plekton::geometry
