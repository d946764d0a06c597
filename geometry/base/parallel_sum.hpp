// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/thread_pool.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace plekton::geometry {

/// Sums over many indices, the same bits for any number of threads: what body(begin, end, worker)
/// returns for each 256 indices is added in order. Sum is a number, an Eigen vector, or anything
/// that starts at zero when value-initialised and has +=. An object keeps its room, so that only a
/// longer sum than any before allocates; it must not be used by two threads at once.
template <class Sum>
class ParallelSum {
 public:
  static constexpr std::size_t kChunk = 256;

  /// Calls body once for each chunk of [0, count), on several threads at once; a worker gets its
  /// chunks in ascending order.
  /// @returns the sum of what it returned; zero if there is nothing to add
  /// @throws What body threw.
  template <class Body>
  Sum operator()(std::size_t count, ThreadPool& pool, Body&& body) {
    chunk_sums_.resize((count + kChunk - 1) / kChunk, zero());
    pool.for_each_range(chunk_sums_.size(), [&](std::size_t first, std::size_t last, int worker) {
      for (std::size_t chunk = first; chunk < last; ++chunk) {
        const std::size_t begin = chunk * kChunk;
        chunk_sums_[chunk] = body(begin, std::min(count, begin + kChunk), worker);
      }
    });
    Sum total = zero();
    for (const Sum& sum : chunk_sums_) total += sum;
    return total;
  }

 private:
  static Sum zero() {
    if constexpr (requires { Sum::Zero(); }) {
      return Sum::Zero();
    } else {
      return Sum{};
    }
  }

  std::vector<Sum> chunk_sums_;
};

}  // namespace plekton::geometry
