// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/neighbor/broad_phase.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>
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

  /// Takes others. @param newer  of a pair that is there already too; in any order
  void merge(PairNumbers newer) {
    if (newer.rows_.empty()) return;
    const auto is_before = [](const Row& a, const Row& b) { return a.pair < b.pair; };
    std::ranges::sort(newer.rows_, is_before);
    std::vector<Row> all;
    std::ranges::merge(newer.rows_, rows_, std::back_inserter(all), is_before);
    const auto is_same = [](const Row& a, const Row& b) { return a.pair == b.pair; };
    all.erase(std::unique(all.begin(), all.end(), is_same), all.end());
    rows_ = std::move(all);
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
