// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace plekton::geometry {

/// Corners of triangles, as positions in a polygon.
using PolygonTriangles = std::vector<std::array<std::size_t, 3>>;

/// Largest number of corners that is cut. The time grows with the square of it, and with the cube
/// at worst.
inline constexpr std::size_t kLargestPolygon = 1024;

/// Cuts a polygon into triangles without new points, oriented as the polygon.
///
/// The polygon is looked at along the coordinate axis nearest to its mean normal (the others if it
/// is not simple there), where all decisions are exact, so every triangle has an area and the
/// triangles tile the polygon also if it is concave, warped, or has corners on the line between
/// their neighbours. Convex quadrilaterals are cut along the shorter diagonal, others by removing
/// ears.
/// @param x  m. Corners in order, at least three, neighbours distinct, not all on one line.
/// @returns No value if the polygon crosses or touches itself in every view, or has more than
///          kLargestPolygon corners.
std::optional<PolygonTriangles> triangulate_polygon(std::span<const Vec3> x);

/// Largest distance (m) of a corner from the plane through the mean of the corners along their mean
/// normal.
double warp(std::span<const Vec3> x);

}  // namespace plekton::geometry
