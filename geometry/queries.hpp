// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// The geometry kernel as a library, without any dynamics. Lengths in m, the signs and frames of
/// proximity.hpp.
///
///     Elements, Surface        spheres, cylinders and facets over shared nodes
///     proximity()              two primitives: nearest points, features, gap, normal
///     ProximityQuery           all pairs of a scene nearer than a distance, while it moves
///     SurfaceQuery             a surface: nearest to a point, ball, cylinder, facet or surface;
///                              first hit and all hits of a ray; inside or outside, and signed
///                              distance, of closed ones; many questions at once
///     hit()                    a ray and one thick primitive
///     first_contact()          two primitives that move during a step
///
/// A radius may be 0. Ids are places in tables: those of a SphereId and a FaceId in the tables of
/// spheres and facets, and Surface::place_of() gives that of a cell. Distances may be as small as a
/// double can be between sides longer than 1e-140 m, and coordinates must be below 1e75 m.
///
/// Whatever names a feature is decided exactly. Degenerate primitives are allowed: a facet without
/// area is the union of its sides, a cylinder without length a ball. Cores that meet are reported
/// as such (Relation), with the shortest way out.
///
/// Wrong input of Surface, ProximityQuery, SurfaceQuery and first_contact() throws
/// std::invalid_argument with a line for every problem, which names the node, element or probe by
/// its place; of more than eight nodes or probes alike the last line tells how many. A ray that
/// cannot hit anything (can_hit()) hits nothing. Inside and outside of a surface that is not closed
/// is a std::logic_error, and a loop within a loop of the same ThreadPool; std::bad_alloc and
/// std::system_error are the system's. What is noexcept, as proximity() and hit(), checks nothing,
/// for it is asked millions of times in a second: ids must be those of the surface, a probe must
/// have one to three corners, coordinates and radii must be finite and below 1e75 m, and radii not
/// negative. Answers to anything else mean nothing, and reading past the end of a table is not
/// excluded.
#include "geometry/base/thread_pool.hpp"
#include "geometry/closest/primitive_pairs.hpp"
#include "geometry/primitives/elements.hpp"
#include "geometry/query/first_contact.hpp"
#include "geometry/query/proximity_query.hpp"
#include "geometry/query/ray.hpp"
#include "geometry/query/surface_query.hpp"
