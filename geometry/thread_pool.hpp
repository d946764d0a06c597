// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
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
  /// called all the same. The calling thread is worker 0; with one thread this is a plain call. No
  /// allocation unless a body throws.
  /// @throws What a body threw, after all have ended; the lowest worker's if several did.
  /// std::logic_error if a loop of
  ///         this pool is running.
  template <class Body>
  void for_each_range(std::size_t count, Body&& body) {
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

 private:
  struct Task {
    std::size_t count;
    void* body;
    void (*call)(void* body, std::size_t begin, std::size_t end, int worker);
  };

  void run(const Task& task);
  void work(int worker);
  void do_part(int worker) noexcept;
  void stop() noexcept;

  int thread_count_;
  int looks_;  // How often an idle thread looks for news before it blocks.
  Task task_{};
  bool stopping_ = false;
  std::atomic<bool> busy_ = false;
  std::vector<std::exception_ptr> failures_;  // One place for each worker.
  // Written by one side and watched by the other: each on its own cache line.
  alignas(64) std::atomic<std::uint32_t> round_ = 0;
  alignas(64) std::atomic<std::uint32_t> unfinished_ = 0;
  std::vector<std::jthread> threads_;
};

}  // namespace plekton::geometry
