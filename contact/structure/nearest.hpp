// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/structure/normal_spring.hpp"
#include "contact/structure/simplex.hpp"
#include "geometry/closest/core_pair.hpp"

/// What the nearest points of two convex simplices store and how they push: phi(distance), at these
/// points. Where the simplices are parallel the nearest points are many; each end of their overlap
/// then gets its share (tilt_share.hpp), so that the force, where it acts and its stiffness change
/// continuously with every motion of the corners, and derive from one energy:
///
/// - facet and facet, nearly parallel: every corner of the overlap, the share of the sector of its
///   normals;
/// - an edge, nearly parallel to a facet: both ends of its part above the facet;
/// - two edges beside each other: both ends of the part, and the nearest point between them;
/// - anything else: the nearest points.
///
/// Edges that facets share are told apart by is_seam: two of them that run side by side between
/// parallel sheets are part of the sheets' overlap and keep their nearest points.
namespace plekton::contact::structure {

using geometry::CoreProximity;

/// Whether the first two cases may hold. If they do not, neither do they for features of both that
/// hold the nearest points.
bool may_be_flat(const Simplex& a, const Simplex& b, const CoreProximity& nearest);

/// Of simplices whose cores do not meet.
/// @param nearest  their nearest points, nearer than the spring's range
/// @param may_be_flat  what the function of that name says; true if that is not known
PairForces nearest_part(const Simplex& a, const Simplex& b, const CoreProximity& nearest,
                        bool may_be_flat, const NormalSpring& spring);

/// Of simplices of any kind: energy and force along the line of the nearest points; of cores that
/// meet along the shortest way out, with its length as overlap too.
PairForces at_nearest_points(const CoreProximity& nearest, const NormalSpring& spring);

}  // namespace plekton::contact::structure
