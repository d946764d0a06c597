// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"
#include "geometry/primitives/proximity.hpp"

#include <cstdint>

/// Nearest points of the cores of two primitives: points, segments and triangles, each given by the
/// positions of its corners.
///
/// What is decided is exact: whether the cores meet, and which feature (corner, side, face) of each
/// core holds its nearest point. A pair of points p, q of two convex cores is a nearest one if and
/// only if no corner of a lies on q's side of the plane through p across q - p, and no corner of b
/// on p's side of that through q. For every pair of features that can carry the nearest points
/// (corner and corner, corner and side, corner and face, side and side) these conditions, and those
/// for the foot points to lie inside the features, are signs of polynomials of degree 2, 3 and 4 of
/// coordinate differences. So a guess made in double is certified, or replaced by the first pair of
/// features that passes.
///
/// Ties, which parallel features have, go to the lowest sum of dimensions; then to the side that is
/// lower in lower_side(); then to the lowest corners. The answer for (b, a) is that for (a, b) with
/// the sides exchanged and the separation reversed, bit for bit. Segments without length and
/// triangles without area are the union of their lower features.
///
/// Coordinates must be finite and below 1e75 in magnitude (m). The distance may be as small as a
/// double can be, but sides have to be longer than 1e-140 m for its accuracy and that of the
/// weights; what is decided is exact for shorter ones too.
namespace plekton::geometry {

struct ClosestPoints {
  Vec3 weights_a;  ///< of the corners of a: each >= 0, sum 1, 0 for corners that do not exist
  Vec3 weights_b;
  Vec3 separation;  ///< m, from the point on a to that on b, right to 1e-12 of its length; zero if
                    ///< they meet
  double distance;  ///< m; relative error at most 1e-12; 0 if the cores meet
  unsigned corners_a;  ///< bit k: corner k spans the lowest feature of a that holds the point
  unsigned corners_b;
  Relation relation;
};

/// How the pairs of a thread were decided, since it started. For reports and tests.
struct ClosestCounters {
  std::uint64_t pairs = 0;          ///< segment-segment, segment-triangle and triangle-triangle
  std::uint64_t enumerated = 0;     ///< ties, cores that meet, and guesses that were refuted
  std::uint64_t exact_lengths = 0;  ///< a double was too short for the distance
};
ClosestCounters& closest_counters() noexcept;

}  // namespace plekton::geometry
