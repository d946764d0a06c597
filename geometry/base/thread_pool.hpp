// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/function_ref.hpp"

#include <cstddef>
#include <memory>

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
    run(count, body);
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
    run_shared(count, body);
  }

 private:
  class Crew;

  void run(std::size_t count, FunctionRef<void(std::size_t, std::size_t, int)> body);
  void run_shared(std::size_t count, FunctionRef<void(std::size_t, int)> body);

  int thread_count_;
  std::unique_ptr<Crew> crew_;  ///< apart: what threads need takes long to compile
};

}  // namespace plekton::geometry
