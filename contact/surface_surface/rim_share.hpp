// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_surface/simplex.hpp"

/// Where two facets lie beside each other.
///
/// Facets in nearly one plane that are nearest at their rims have no area over each other, and
/// would not push at all. With d the direction from one nearest point to the other, and both of
/// them on rims, what the tilt takes from their share (point_share.hpp) is given back by the part
///
///     F = (1 - (d.n_a)^2) (1 - (d.n_b)^2)        n: the normals of the facets
///
/// of it: 1 where they lie beside each other in one plane, 0 where one rim is above the other. A
/// nearest point that leaves the rim for the inside of its facet has d along the normal: nothing
/// jumps. One that leaves it along a seam has the same place as the nearest point of the seam,
/// which counts as often against it.
namespace plekton::contact::structure {

/// @param corners_a, corners_b  bit k: corner k spans the node or edge of the rim that holds the
///                              nearest point
/// @returns F, the corners of both facets are its variables
Real rim_share(const Simplex& a, unsigned corners_a, const Simplex& b, unsigned corners_b);

}  // namespace plekton::contact::structure
