// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "geometry/base/pack.hpp"
#include "geometry/neighbor/neighbours.hpp"
#include "geometry/primitives/elements.hpp"

#include <span>
#include <vector>

namespace plekton::contact {

/// Of the cells in the list of a sphere, those that may be in range now: each cell is deferred for
/// as long as it cannot be.
///
/// When a cell is looked at and is out of range by a clearance c
/// (geometry/primitives/cell_clearance.hpp), it can come into range only after the sphere and the
/// cell have together moved by c: no point of a cell moves further than the one of its nodes that
/// moves most. Let moved be the sum over the steps of twice the largest displacement of any node:
/// the cell is deferred until it has grown by c. So in most steps a pair costs one comparison and
/// a look at the few cells that are due: O(pairs + cells in range), while the list, which is made
/// for many steps, holds several times as many.
///
/// Rounding: as in geometry/neighbor/skin.hpp, a step x += v dt is rounded by at most 4 eps of the
/// way and of the coordinate; the sums are rounded up.
class DeferredPairs {
 public:
  using NearCells = geometry::NearCells;

  explicit DeferredPairs(const geometry::Surface& surface) : surface_(&surface) {}

  /// Takes a new list; all are due.
  void rebuild(std::span<const geometry::CellId> cells);

  /// Begins a step. All are due in the first step of a list, and where the displacement of the
  /// nodes is not known: O(number of nodes) then, else O(1).
  void begin_step(const Motion& motion) noexcept;

  /// Of all pairs together.
  std::size_t cell_count() const noexcept { return cells_.size(); }

  /// What is known of the cells of a pair; at first nothing.
  struct NextCheck {
    double at = 0.0;          ///< m, what moved has to be before another one may be in range
    std::uint32_t count = 0;  ///< may be in range now: the first ones of its part of the list
  };

  /// Whether none of the cells of a pair can be in range.
  bool is_deferred(const NextCheck& next_check) const noexcept {
    return next_check.count == 0 && is_known(next_check);
  }

  /// Whether those that were due in the last step are all that can be in range.
  bool is_known(const NextCheck& next_check) const noexcept {
    return !all_are_due_ && moved_ < next_check.at;
  }

  /// Asks for what find() will read of these.
  PLEKTON_INLINE void ask_ahead(const NearCells& near) const noexcept {
    __builtin_prefetch(check_at_.data() + near.first);
    __builtin_prefetch(cells_.data() + near.first);
  }

  /// The cells of a pair that may be nearer than range (m) to its sphere, ascending.
  /// @param near   a part of the list; one thread at a time for each
  /// @param next_check  of this pair, from its last step
  /// @param found  to which they are added
  void find(const NearCells& near, const Vec3& centre, double range, Positions x,
            NextCheck& next_check, std::vector<geometry::CellId>& found);

 private:
  const geometry::Surface* surface_;
  std::vector<geometry::CellId> cells_;  ///< of each pair, those that are due first
  std::vector<double> check_at_;  ///< m, by place in cells_: what moved_ has to be; negative:
                                  ///< so many steps more it is taken to be in range
  double moved_ = 0.0;            ///< m, twice the way of any node at most since all were due
  double furthest_ = 0.0;         ///< m, largest coordinate at that time
  bool is_new_ = true;            ///< no step of this list yet
  bool all_are_due_ = true;       ///< in this step
};

}  // namespace plekton::contact
