// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/neighbor/broad_phase.hpp"

#include <cstdint>
#include <vector>

namespace plekton::contact {

/// Numbers of pairs of spheres, in the order of the pairs.
class PairNumbers {
  struct Row {
    geometry::IndexPair pair;
    std::int64_t number;
  };

 public:
  /// @param pair  after all that were added before
  void add(const geometry::IndexPair& pair, std::int64_t number) {
    rows_.push_back({pair, number});
  }

  /// Looks pairs up one after the other.
  class Reader {
   public:
    explicit Reader(const PairNumbers& numbers) : rows_(numbers.rows_) {}

    /// @param pair  after those that were asked for before; 0 if it has no number
    std::int64_t of(const geometry::IndexPair& pair) {
      while (next_ < rows_.size() && rows_[next_].pair < pair) ++next_;
      return next_ < rows_.size() && rows_[next_].pair == pair ? rows_[next_].number : 0;
    }

   private:
    const std::vector<Row>& rows_;
    std::size_t next_ = 0;
  };

 private:
  std::vector<Row> rows_;
};

}  // namespace plekton::contact
