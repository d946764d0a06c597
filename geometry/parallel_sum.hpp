// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/thread_pool.hpp"
#include "geometry/types.hpp"

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace plekton::geometry {

/// Sums over many indices, the same bits for any number of threads: the terms of each 256 indices
/// are added in order, then these sums in order. Value is double or Vec3. An object keeps its room,
/// so that only a longer sum than any before allocates; it must not be used by two threads at once.
template <class Value>
class ParallelSum {
 public:
  static constexpr std::size_t kChunk = 256;

  /// The sum of term(i) over [0, count); zero if there is none. The terms are asked for by several
  /// threads at once.
  /// @throws What a term threw.
  template <class Term>
  Value operator()(ThreadPool& pool, std::size_t count, const Term& term) {
    chunk_sums_.resize((count + kChunk - 1) / kChunk);
    pool.for_each_range(chunk_sums_.size(), [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t chunk = begin; chunk < end; ++chunk) {
        Value sum = zero();
        const std::size_t last = std::min(count, (chunk + 1) * kChunk);
        for (std::size_t i = chunk * kChunk; i < last; ++i) sum += term(i);
        chunk_sums_[chunk] = sum;
      }
    });
    Value total = zero();
    for (const Value& sum : chunk_sums_) total += sum;
    return total;
  }

 private:
  static Value zero() {
    if constexpr (std::is_arithmetic_v<Value>) {
      return Value{0};
    } else {
      return Value::Zero();
    }
  }

  std::vector<Value> chunk_sums_;
};

}  // namespace plekton::geometry
