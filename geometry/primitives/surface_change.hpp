// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/elements.hpp"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace plekton::geometry {

/// Where the features of a surface are in another part of the same whole (Surface::left_with), as in
/// what is left of it: what refers to them goes on with their new numbers, in the same order as
/// before.
class SurfaceChange {
 public:
  /// Linear in the number of features, times their logarithm where some have come.
  /// @param before, after  must outlive this; parts of one surface, or one of the other
  SurfaceChange(const Surface& before, const Surface& after);

  const Surface& before() const noexcept { return *before_; }
  const Surface& after() const noexcept { return *after_; }

  /// A feature's new number; none if it is gone. A node that has lost its last element is gone.
  std::optional<Feature> now(Feature feature) const noexcept;
  /// Likewise of a cell.
  std::optional<CellId> now(CellId cell) const noexcept;

  /// What there is of a cell now, ascending: itself; of a torn facet its sides that are cylinders
  /// now; nothing.
  std::vector<CellId> left_of(CellId cell) const;

 private:
  const Surface* before_;
  const Surface* after_;
  std::vector<EdgeId> edges_;  ///< by old id; -1: gone
  std::vector<FaceId> faces_;
};

}  // namespace plekton::geometry
