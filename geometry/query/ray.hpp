// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/closest/primitive_pairs.hpp"

#include <limits>
#include <optional>

namespace plekton::geometry {

/// The points origin + t direction, 0 <= t <= t_end.
struct Ray {
  Vec3 origin;     ///< m, below 1e75
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

/// Whether a ray has a direction and numbers in the ranges above, so that it can hit anything.
bool can_hit(const Ray& ray) noexcept;

/// How far (m) rounding may put the point of a ray at t beside it; what is as near as this is hit.
/// That is some ulps of the way from the origin: 1e-13 m from 100 m away, but 60 km from 1e20 m.
double resolution(const Ray& ray, double t) noexcept;

/// Where a ray enters a cell: a capsule, or a plate with rounded rims. It is found by Newton's
/// method on the distance from the core, which is convex along a line, so the steps never pass the
/// entry and the feature at its end is the exact one. The distance of the point from the core is
/// within a few ulps of (radius + the way of the ray + the distance of its origin from that of the
/// coordinates) of the radius; rays that graze within about
/// that distance may or may not hit, here and in SurfaceQuery::first_hit alike. Of an origin on the
/// core itself the normal is perpendicular to the feature.
/// @returns nothing if the ray misses, or cannot hit
std::optional<RayHit> hit(const Ray& ray, const PlacedSurface& on, CellId cell) noexcept;

}  // namespace plekton::geometry
