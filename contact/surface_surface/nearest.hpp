// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_surface/normal_spring.hpp"
#include "contact/surface_surface/simplex.hpp"
#include "geometry/closest/core_pair.hpp"

/// What the nearest points of two convex simplices store and how they push: phi(distance), at these
/// points. Where a free cylinder is parallel to the other the nearest points are many; both ends of
/// the part side by side then get their share (tilt_share.hpp), so that the force and where it acts
/// change continuously with every motion of the corners, and derive from one energy:
///
/// - a cylinder, nearly parallel to a facet: both ends of its part above the facet; where that ends
///   at a side of the facet, what is nearest to that side;
/// - a cylinder and an edge beside each other: both ends of the part, and the nearest point
///   between;
/// - anything else: the nearest points. Facets that lie flat on each other have none that matter
///   (point_share.hpp). Where a ridge or a rim of facets lies along a facet the force goes to the
///   end that is nearer, also by a rounding error: the energy is continuous there, and the force on
///   every node stays below that of one contact.
///
/// Edges that facets share are told apart by is_seam: one that a cylinder runs along is part of
/// what its facets do, and keeps its nearest points.
namespace plekton::contact::structure {

using geometry::CoreProximity;

/// Whether the first case may hold. If they do not, neither do they for features of both that
/// hold the nearest points.
bool may_be_flat(const Simplex& a, const Simplex& b, const CoreProximity& nearest);

/// Of simplices whose cores do not meet.
/// @param nearest  their nearest points, nearer than the spring's range
/// @param may_be_flat  what the function of that name says; true if that is not known
PairForces nearest_part(const Simplex& a, const Simplex& b, const CoreProximity& nearest,
                        bool may_be_flat, const NormalSpring& spring);

/// Of simplices of any kind: energy and force along the line of the nearest points; of cores that
/// meet along the shortest way out, with its length as overlap too.
/// @param nearest  of cores that meet the points that touch last (geometry::at_last_touch)
PairForces at_nearest_points(const CoreProximity& nearest, const NormalSpring& spring);

/// A force (N) along the line of the nearest points, without energy.
PairForces pushing_apart(const CoreProximity& nearest, double force);

}  // namespace plekton::contact::structure
