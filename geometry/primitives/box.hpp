// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <span>

namespace plekton::geometry {

/// Box aligned with the world axes (m). Closed: boxes that only touch overlap.
struct Box {
  Vec3 lower;
  Vec3 upper;
};

/// Smallest box around points (m), grown by a margin (m) on every side and rounded outward, so that
/// it holds the Minkowski sum of their hull with a ball of that radius in exact arithmetic too. At
/// least one point.
Box bounding_box(std::span<const Vec3> points, double margin) noexcept;

}  // namespace plekton::geometry
