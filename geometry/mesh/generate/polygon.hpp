// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

#include <vector>

namespace plekton::geometry {

struct Polygon {
  std::vector<Vec3> points;  ///< m, corners in order, counterclockwise seen from where it faces;
                             ///< from 3 to 1024; the last one is joined to the first
};

/// Mesh of a polygon in a plane, convex or not, with no node beside its corners, cut along
/// diagonals: no facet is without area, by exact signs.
/// @throws MeshError for fewer than 3 or more than 1024 points, any that is not finite, two equal
///         ones in a row, points that are all on one line (to 1e-9 of their distance), one that is
///         out of the plane of the others by more than 1e-4 of the largest distance from the first,
///         and sides that touch or cross
Mesh polygon(const Polygon& polygon);

}  // namespace plekton::geometry
