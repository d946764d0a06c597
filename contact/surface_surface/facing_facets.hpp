// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_surface/normal_spring.hpp"
#include "contact/surface_surface/simplex.hpp"

namespace plekton::contact::structure {

/// Facets whose planes cross at a larger angle than this cosine's have no energy by extent.
inline constexpr double kCosineOfCrossing = 0.9;

/// What round-off makes of a point on a plane is below this times the numbers it comes from.
inline constexpr double kPlaneRoundoff = 1e-12;

/// What two facets that face each other add by the extent of their overlap: the integral of the
/// spring's energy over the overlap, as far as it is in range, times the factor of
/// parallel_share(), over the square of the range. The overlap is the part of either facet over the
/// other, seen along the other's normal, with the distance from the other's plane: half of it from
/// each side. So where the overlap with a facet ends does not depend on which facet of the other
/// body lies there, and the sum over the facets of two sheets has no corner where their edges
/// coincide.
///
/// The gradient is found backwards, from the energy to the corners: a few times the cost of the
/// energy alone, for all 18 coordinates. Source: Griewank & Walther, Evaluating Derivatives (2008),
/// section 3.2.
PairForces facing_facets(const Simplex& a, const Simplex& b, const NormalSpring& spring);

/// 1 for parallel bodies, 0 and flat where they count as crossing.
template <class Number>
Number parallel_share(const Number& cosine) {
  const Number share = (1.0 / (1.0 - kCosineOfCrossing)) * (cosine - Number(kCosineOfCrossing));
  return still(share) <= 0.0 ? Number(0.0) : share * share;
}

}  // namespace plekton::contact::structure
