// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/thread_pool.hpp"
#include "geometry/primitives/sphere.hpp"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace plekton::geometry {

/// One of several parts of a search: each pair is found in one of them.
struct SearchShare {
  std::size_t part = 0;
  std::size_t count = 1;
};

/// Two indices that belong together; ordered by a, then b.
struct IndexPair {
  std::int32_t a;
  std::int32_t b;

  friend constexpr auto operator<=>(const IndexPair&, const IndexPair&) = default;
};

/// Which world-axis boxes overlap, found by FCL's dynamic tree of boxes. It knows nothing else:
/// what is inside a box, and how far a box was grown, is the caller's affair.
///
/// Boxes are closed: boxes that only touch overlap. A box may have no volume, and may be unbounded:
/// a coordinate beyond 1e150 counts as 1e150, and NaN as unbounded, so a spoilt box overlaps too
/// much and never too little.
///
/// With n boxes and p pairs, rebuild takes O(n log n), refit O(n), self_pairs and pairs_with
/// O(n + p) for boxes of similar size. Nothing allocates unless n or p is larger than ever before.
/// The const functions may run at the same time on different objects; on the same object only
/// query may.
class BroadPhase {
 public:
  /// No boxes.
  /// @throws std::logic_error if the FCL that is linked does not find the overlap of two boxes that
  ///         overlap; this is tried once in a process. The message names the known cause, Eigen's
  ///         alignment, and the cure.
  BroadPhase();
  BroadPhase(BroadPhase&&) noexcept;
  BroadPhase& operator=(BroadPhase&&) noexcept;
  ~BroadPhase();

  /// Takes up to 2^30 boxes, also none. A box's place in the span is its index from now on.
  void rebuild(std::span<const Box> boxes);
  void rebuild(const SphereBoxes& boxes);

  /// Moves the boxes, any way and any distance. Several times cheaper than rebuild, but the further
  /// boxes have wandered among each other since then, the longer finding their pairs takes.
  /// @throws std::invalid_argument if the number of boxes is not the one of the last rebuild.
  void refit(std::span<const Box> boxes);
  void refit(const SphereBoxes& boxes);

  /// Number of boxes.
  std::size_t size() const noexcept;

  /// All pairs a < b of overlapping boxes, each once, in order. Replaces what pairs held.
  void self_pairs(std::vector<IndexPair>& pairs) const;
  /// The same on several threads.
  void self_pairs(std::vector<IndexPair>& pairs, ThreadPool& pool) const;
  /// Only those of them that are wanted.
  /// @param is_wanted  asked by several threads at the same time
  /// @param share      looks only there
  void self_pairs(std::vector<IndexPair>& pairs, ThreadPool& pool,
                  const std::function<bool(const IndexPair&)>& is_wanted,
                  const SearchShare& share = {}) const;

  /// All pairs of a box of this (a) and an overlapping box of the other (b), each once, in order.
  /// Replaces what pairs held.
  void pairs_with(const BroadPhase& other, std::vector<IndexPair>& pairs) const;

  /// Indices of the boxes that overlap a box, in order. Replaces what indices held.
  void query(const Box& box, std::vector<std::int32_t>& indices) const;

 private:
  template <class Boxes>
  void rebuild_of(const Boxes& boxes);
  template <class Boxes>
  void refit_of(const Boxes& boxes);

  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace plekton::geometry
