// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/thread_pool.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace plekton::contact {

/// Runs body(begin, end, worker) -> double over fixed chunks of [0, count) and sums what it returns in the order of the
/// chunks: the same bits for any number of threads. A worker gets its chunks in ascending order.
class ChunkedSum {
 public:
  template <class Body>
  double operator()(std::size_t count, geometry::ThreadPool& pool, Body&& body) {
    constexpr std::size_t kChunk = 256;
    parts_.resize((count + kChunk - 1) / kChunk);
    pool.for_each_range(parts_.size(), [&](std::size_t first, std::size_t last, int worker) {
      for (std::size_t chunk = first; chunk < last; ++chunk) {
        parts_[chunk] = body(chunk * kChunk, std::min(count, (chunk + 1) * kChunk), worker);
      }
    });
    return std::accumulate(parts_.begin(), parts_.end(), 0.0);
  }

 private:
  std::vector<double> parts_;
};

}  // namespace plekton::contact
