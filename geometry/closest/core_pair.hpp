// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/closest/certificate.hpp"
#include "geometry/closest/closest_points.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace plekton::geometry {

/// Corners of a point, a segment or a triangle (m).
struct Core {
  std::array<Vec3, 3> x;
  std::size_t count = 0;

  std::span<const Vec3> corners() const noexcept { return {x.data(), count}; }
};

/// Nearest points of two cores of any kind (closest_points.hpp).
ClosestPoints closest_points(const Core& a, const Core& b) noexcept;

/// Two cores and the direction in which they are apart, or in which they have to go to be.
struct CoreProximity {
  ClosestPoints points;
  Vec3 normal;  ///< unit, from a to b; of cores that meet the shortest way for b out of a
  double signed_distance;  ///< m, negative (or 0) for cores that meet: minus the length of that way
};

/// A point on a core goes out perpendicular to the feature it lies in, in a direction that depends
/// on that feature alone.
/// @param side  see deep_separation(); which way out of cores that meet
CoreProximity core_proximity(const Core& a, const Core& b,
                             const Vec3& side = Vec3::Zero()) noexcept;

/// The same, bit for bit, and sooner if a guess is right.
/// @param guess  features that may carry the nearest points, such as those of a moment ago
CoreProximity core_proximity(const Core& a, const Core& b,
                             const closest::WitnessFeatures& guess) noexcept;

/// The same, for cores that meet with the points that touch last as b goes out of a, instead of one
/// that they have in common: from the one on a to the one on b it is signed_distance * normal, as
/// for cores that are apart. So the slope of the signed distance by the corners is what a unit
/// force along the normal does there: minus the weights times the normal on a, plus on b. Source:
/// the nearest point of the boundary of the Minkowski difference is a convex combination of
/// differences of corners, which are the multipliers of the minimum (Danskin's theorem).
/// @param a, b   m
/// @param found  of core_proximity(); what is apart or only touches stays as it is
CoreProximity at_last_touch(const Core& a, const Core& b, const CoreProximity& found) noexcept;

}  // namespace plekton::geometry
