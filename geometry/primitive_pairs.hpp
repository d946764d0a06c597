// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/elements.hpp"
#include "geometry/proximity.hpp"

/// The pairs of primitives that can touch, and where they are nearest to each other.
///
///               sphere        cylinder            facet
///     sphere    sphere        cell of a surface   cell of a surface
///
/// A cylinder or a facet is asked as a cell of its Surface, so that the answer names the node, edge
/// or face that neighbouring cells share: two facets agree bit for bit about a foot point on their
/// common edge.
namespace plekton::geometry {

/// Two spheres. Of coincident centres the normal is the z axis.
Proximity proximity(const Sphere& a, const Sphere& b, Positions x) noexcept;

/// A sphere (a) and a cell of a surface (b), rim and ends included. Which feature of the cell is
/// nearest is decided exactly. A centre on the core itself gets a normal perpendicular to the
/// feature, chosen by the feature alone. A facet without area is the union of its sides, a cylinder
/// without length its node.
Proximity proximity(const Sphere& a, const Surface& surface, CellId cell, Positions x) noexcept;

}  // namespace plekton::geometry
