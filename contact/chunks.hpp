// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/thread_pool.hpp"

#include <algorithm>
#include <vector>

namespace plekton::contact {

/// Runs body(begin, end, worker) -> Sum over fixed chunks of [0, count) and adds what it returns in the order of the
/// chunks: the same bits for any number of threads. A worker gets its chunks in ascending order. Sum is a number, or
/// anything that starts at zero and has +=.
template <class Sum>
class ChunkedSum {
 public:
  template <class Body>
  Sum operator()(std::size_t count, geometry::ThreadPool& pool, Body&& body) {
    constexpr std::size_t kChunk = 256;
    parts_.resize((count + kChunk - 1) / kChunk);
    pool.for_each_range(parts_.size(), [&](std::size_t first, std::size_t last, int worker) {
      for (std::size_t chunk = first; chunk < last; ++chunk) {
        parts_[chunk] = body(chunk * kChunk, std::min(count, (chunk + 1) * kChunk), worker);
      }
    });
    Sum sum{};
    for (const Sum& part : parts_) sum += part;
    return sum;
  }

 private:
  std::vector<Sum> parts_;
};

}  // namespace plekton::contact
