// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_surface/normal_spring.hpp"
#include "contact/surface_surface/simplex.hpp"

/// Contact along a line or over an area. Where bodies run side by side, every range (sum of radii)
/// of length, or range^2 of area, counts as one more contact: with phi the energy of one contact at
/// a distance,
///
///     facet, facet             integral of phi dA / range^2   over the overlap, from both sides
///     free cylinder, facet     integral of phi dl / range     over the cylinder, with the distance
///                                                             to the facet
///     free cylinder, side      the same with the distance to the side; to be subtracted where
///                              facets share it
///     free cylinder, cylinder  integral of phi dl / range     over the part side by side
///
/// times a factor that is 1 for parallel bodies and falls to 0 at 26 degrees (cosine 0.9): bodies
/// that cross touch at a point. Integrals over the parts of a mesh add up to that over the whole,
/// so the mesh does not matter. Together with the nearest points (nearest.hpp), n ranges of length
/// count as 1 + n contacts: the length of a cylinder with its round ends, in diameters, as in
/// Steiner's formula for the measure of a rounded body. Facets that lie flat on each other count by
/// their area alone (point_share.hpp).
namespace plekton::contact::structure {

/// Whether a pair may have an extent: not if a node is in it, or two edges of facets.
bool can_extend(const Simplex& a, const Simplex& b);

/// Where cores cross, what lies beyond the crossing counts by its distance too, on that side: the
/// energy goes on where they meet, largest there.
PairForces extended_part(const Simplex& a, const Simplex& b, const NormalSpring& spring);

}  // namespace plekton::contact::structure
