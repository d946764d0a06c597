// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

#include <cstdint>

/// Meshes from a few numbers. All share their nodes; lengths in m. Each throws MeshError for a
/// length that is not positive and below 1e75 m, for a number of divisions below its least, and
/// before anything is made for more nodes than their numbers count.
namespace plekton::geometry {

/// How the cells of a sheet are cut.
enum class SheetPattern : std::uint8_t {
  diagonal,     ///< 2 facets a cell, all cut the same way
  alternating,  ///< 2 facets a cell, neighbours cut the other way (union jack)
  cross         ///< 4 facets a cell around a node in its middle
};

struct PlaneSheet {
  double width;   ///< m, along x
  double length;  ///< m, along y
  int cells_x;    ///< at least 1
  int cells_y;    ///< at least 1
  SheetPattern pattern = SheetPattern::alternating;
};

/// Flat sheet in the plane z = 0, centred on the origin, facing +z.
Mesh plane_sheet(const PlaneSheet& sheet);

struct Tube {
  double radius;  ///< m, of the circle through the nodes
  double length;  ///< m
  int around;     ///< cells around, at least 3
  int along;      ///< cells along, at least 1
};

/// Open tube around the z axis from z = 0 to its length, facing outward; every second ring is
/// turned by half a cell.
Mesh tube(const Tube& tube);

/// Sphere around the origin with its nodes on the given radius: an icosahedron, every facet cut
/// into four as often as told (0 to 12): 20 * 4^subdivisions facets, facing outward.
Mesh icosphere(double radius, int subdivisions);

/// Closed box from the origin to a corner, facing outward, each side cut into cells of two facets.
/// @param size       m.
/// @param divisions  Cells along each axis, at least 1.
Mesh box_shell(const Vec3& size, const std::array<int, 3>& divisions = {1, 1, 1});

}  // namespace plekton::geometry
