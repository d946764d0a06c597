// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

/// Decisions of the mesh import that must not depend on rounding: the answers are those of exact
/// arithmetic on the given doubles. Behind them are CGAL's filtered predicates.
namespace plekton::geometry {

/// True if three points lie on one line, which includes coinciding ones: the triangle has no area.
bool are_collinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// A coordinate axis: 0 for x, 1 for y, 2 for z.
struct Axis {
  int value;
};

/// Seen from far out on the positive side of an axis, do a, b, c turn to the left (1), to the right
/// (-1) or lie on a line (0)?
int turn(Axis along, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace plekton::geometry
