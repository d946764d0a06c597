// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <span>

namespace plekton::geometry {

/// How to take two cores apart that touch or cross.
struct DeepSeparation {
  Vec3 direction;  ///< unit, from a to b: the way b has to go
  double depth;    ///< m, >= 0: how far until the cores only touch
};

/// The shortest translation that takes two cores apart, of points, segments or triangles that meet
/// (ClosestPoints::relation). Bodies of radii r_a and r_b around them need depth + r_a + r_b along
/// the same direction.
///
/// The Minkowski difference of the cores is a convex polytope around the origin. Its faces are
/// perpendicular to the normals of both triangles and to the cross products of their sides; the
/// nearest one is found by trying them all, at most 11 directions both ways. Any direction that is
/// tried gives a translation that does take the cores apart, so what rounding does to the normal of
/// a sliver costs optimality only. Of cores in one plane the depth is 0 and the direction the
/// plane's normal; on one line some perpendicular of it; of points the z axis.
///
/// This is not left to libccd: its EPA and MPR polygonise the bodies with their radii and are off
/// by 10 % of the overlap in most cases, and it has no answer for flat cores. It serves the tests
/// as an independent witness.
/// @param a, b  m. 1 to 3 corners each; they may coincide or be collinear
/// @param side  decides which way to go where both are as short, as for every flat pair: the one
///              with the positive product, for instance the last known normal. Zero: an arbitrary
///              but fixed one
DeepSeparation deep_separation(std::span<const Vec3> a, std::span<const Vec3> b,
                               const Vec3& side = Vec3::Zero()) noexcept;

}  // namespace plekton::geometry
