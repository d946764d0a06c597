// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace plekton::geometry {

/// Sets that only ever unite (union-find with path halving). The representative of a set is its
/// lowest member, so the result does not depend on the order in which sets were united.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  std::size_t find(std::size_t i) noexcept {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// @returns true if the two were in different sets.
  bool unite(std::size_t i, std::size_t j) noexcept {
    i = find(i);
    j = find(j);
    if (i == j) return false;
    if (j < i) std::swap(i, j);
    parent_[j] = i;
    return true;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace plekton::geometry
