// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <cstddef>
#include <span>

/// Whether a pair of features carries the nearest points of two cores: the exact part of
/// closest_points.hpp.
namespace plekton::geometry::closest {

/// Positions of the 1, 2 or 3 corners of a core (m).
using Corners = std::span<const Vec3>;

/// A feature of each side; bit k: corner k spans it.
struct WitnessFeatures {
  unsigned a;
  unsigned b;

  friend constexpr bool operator==(const WitnessFeatures&, const WitnessFeatures&) = default;
};

enum class Verdict {
  refuted,  ///< the features have no foot points inside, or there are nearer points
  tied,     ///< they carry nearest points, and others may too
  unique,   ///< they carry the nearest points, and nothing else does
  touching  ///< they have one point in common
};

/// Decided exactly, for corner and corner, corner and side, corner and face, and side and side.
/// Sides and faces without extent are refuted.
Verdict certify(Corners a, Corners b, WitnessFeatures witness_features) noexcept;

/// Whether the inside of a side and the inside of a face cross, in one point that is on neither
/// one's plane or line alone. Exact.
bool crosses(Corners segment, unsigned side, Corners triangle) noexcept;

/// Of two cores the one that ties are decided for first: that with fewer corners, then that whose
/// corners come first in the order of their coordinates. @returns whether b is
bool is_lower_side(Corners b, Corners a) noexcept;

}  // namespace plekton::geometry::closest
