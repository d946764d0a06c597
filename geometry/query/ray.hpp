// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitive_pairs.hpp"

#include <limits>
#include <optional>

namespace plekton::geometry {

/// The points origin + t direction, 0 <= t <= t_end.
struct Ray {
  Vec3 origin;     ///< m
  Vec3 direction;  ///< of a length from 1e-150 to 1e150; t counts in it
  double t_end = std::numeric_limits<double>::infinity();
};

/// Where a ray enters a thick primitive.
struct RayHit {
  double t;     ///< 0 if the origin is inside
  Vec3 point;   ///< m, on the rounded outside, or the origin
  Vec3 normal;  ///< unit, outward
  CellId cell;
  CorePoint core;  ///< the core point below the hit, with the feature that is hit
};

/// Where a ray enters a cell: a capsule, or a plate with rounded rims. It is found by Newton's
/// method on the distance from the core, which is convex along a line, so the steps never pass the
/// entry and the feature at its end is the exact one. The distance of the point from the core is
/// within a few ulps of (radius + the way of the ray + the distance of its origin from that of the
/// coordinates) of the radius; rays that graze within about
/// that distance may or may not hit. Of an origin on the core itself the normal is perpendicular to
/// the feature.
/// @returns nothing if the ray misses, ends before it begins, has no direction, or its numbers are
/// not finite
std::optional<RayHit> hit(const Ray& ray, const PlacedSurface& on, CellId cell) noexcept;

}  // namespace plekton::geometry
