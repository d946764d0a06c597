// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// The geometry kernel as a library, without any dynamics. Lengths in m, the signs and frames of
/// proximity.hpp.
///
///     Elements, Surface        spheres, cylinders and facets over shared nodes
///     proximity()              two primitives: nearest points, features, gap, normal
///     ProximityQuery           all pairs of a scene nearer than a distance, while it moves
///     SurfaceQuery             a surface: nearest to a point, ball, cylinder, facet or surface;
///                              first hit of a ray; many questions at once
///     hit()                    a ray and one thick primitive
///
/// Whatever names a feature is decided exactly. Degenerate primitives are allowed: a facet without
/// area is the union of its sides, a cylinder without length a ball. Cores that meet are reported
/// as such (Relation), with the shortest way out. Wrong input throws std::invalid_argument that
/// lists every problem; nothing else is thrown but std::bad_alloc.
#include "geometry/elements.hpp"
#include "geometry/primitive_pairs.hpp"
#include "geometry/proximity_query.hpp"
#include "geometry/query/ray.hpp"
#include "geometry/query/surface_query.hpp"
#include "geometry/thread_pool.hpp"
