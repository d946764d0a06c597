// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_surface/pair_term.hpp"
#include "geometry/primitives/elements.hpp"
#include "geometry/primitives/proximity.hpp"

namespace plekton::contact::structure {

/// Two points opposite each other where a pair of cells presses.
struct PressedPoints {
  geometry::CorePoint a;
  geometry::CorePoint b;
};

/// Elastic force (N) on feature a of a term.
Vec3 force_on_a(const PairTerm& term);

/// Of a term of two cells in range: where its elastic forces act in the mean, or, if there are none
/// or the points there are not within a range (m), where the cells are nearest.
PressedPoints pressed_points(const geometry::Surface& surface, const PairTerm& term, double range,
                             Positions x);

}  // namespace plekton::contact::structure
