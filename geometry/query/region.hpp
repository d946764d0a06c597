// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/query/ball_volume.hpp"

#include <variant>

namespace plekton::geometry {

/// A ball as a region.
struct BallRegion {
  Vec3 centre;    ///< m
  double radius;  ///< m, > 0
};

/// A convex part of space in which something is measured or placed.
using Region = std::variant<BallRegion, Box, CylinderRegion>;

/// m³
double volume(const Region& region) noexcept;

/// Whether a point lies in it; its border belongs to it.
bool contains(const Region& region, const Vec3& point) noexcept;

/// Volume (m³) of a ball that lies in it (ball_volume.hpp).
double ball_volume_in(const Region& region, const Vec3& centre, double radius) noexcept;

/// Part of a segment that lies in it, 0 to 1; of one without length whether its point does.
double segment_part_in(const Region& region, const Vec3& x0, const Vec3& x1) noexcept;

/// Smallest box around it.
Box bounds(const Region& region) noexcept;

}  // namespace plekton::geometry
